#include <benchmark/benchmark.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/threads.h"
#include "procedural/noise_texture.h"
#include "procedural/render.h"
#include "procedural/texture.h"

namespace gramloom {
namespace {

constexpr Target large{{1024, 1024}, Tile::none};

/// The noise alone, 1024² samples into a buffer: what one octave costs a sample.
template <int D>
GRAMLOOM_SIMD void sample_noise(const Lattice<D>& lattice, float* to) {
  for (int y = 0; y < 1024; ++y)
    for (int x = 0; x < 1024; x += pack_size, to += pack_size) {
      Point<D> p{};
      p.at[0] = static_cast<float>(x) + lane_numbers();
      if constexpr (D > 1) p.at[1] = splat(static_cast<float>(y));
      store(noise(lattice, p), to);
    }
}
template <int D>
void noise_alone(benchmark::State& state) {
  Lattice<D> lattice;
  lattice.frequency.fill(32.0f / 1024);
  lattice.seed = 1;
  std::vector<float> buffer(1024 * 1024);
  for (auto _ : state) {
    sample_noise(lattice, buffer.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * 1024 * 1024);
}
BENCHMARK(noise_alone<1>)->Unit(benchmark::kMillisecond);
BENCHMARK(noise_alone<2>)->Unit(benchmark::kMillisecond);
BENCHMARK(noise_alone<3>)->Unit(benchmark::kMillisecond);
BENCHMARK(noise_alone<4>)->Unit(benchmark::kMillisecond);

/// The texture: 1024², one sample a pixel, one thread.
void noise_2d(benchmark::State& state) {
  set_thread_count(1);
  ProceduralParams params;
  Noise noise;
  noise.octaves = static_cast<int>(state.range(0));
  params.texture = noise;
  params.samples = 1;
  params.scale = 32;
  for (auto _ : state) benchmark::DoNotOptimize(synthesise(params, {{}, large, Random(1)}, {}));
  state.SetItemsProcessed(state.iterations() * 1024 * 1024 * state.range(0));
}
BENCHMARK(noise_2d)->Arg(1)->Arg(6)->Unit(benchmark::kMillisecond);

void noise_3d(benchmark::State& state) {
  set_thread_count(1);
  ProceduralParams params;
  Noise noise;
  noise.dimensions = 3;
  noise.octaves = static_cast<int>(state.range(0));
  params.texture = noise;
  params.samples = 1;
  params.scale = 32;
  for (auto _ : state) benchmark::DoNotOptimize(synthesise(params, {{}, large, Random(1)}, {}));
  state.SetItemsProcessed(state.iterations() * 1024 * 1024 * state.range(0));
}
BENCHMARK(noise_3d)->Arg(1)->Arg(6)->Unit(benchmark::kMillisecond);

/// Each texture at 256² with the default samples.
template <std::size_t I>
void texture(benchmark::State& state) {
  set_thread_count(1);
  ProceduralParams params;
  params.texture = std::variant_alternative_t<I, ProceduralTexture>{};
  for (auto _ : state)
    benchmark::DoNotOptimize(synthesise(params, {{}, {{256, 256}, Tile::both}, Random(1)}, {}));
}

template <std::size_t... I>
bool register_all(std::index_sequence<I...>) {
  (benchmark::RegisterBenchmark(
       std::string(std::variant_alternative_t<I, ProceduralTexture>::name).c_str(), texture<I>)
       ->Unit(benchmark::kMillisecond),
   ...);
  return true;
}
[[maybe_unused]] const bool registered =
    register_all(std::make_index_sequence<std::variant_size_v<ProceduralTexture>>{});

}  // namespace
}  // namespace gramloom
