// Quilting and patchmatch: time against the side of the texture and of the exemplar.
#include <benchmark/benchmark.h>

#include "classic/patchmatch.h"
#include "classic/quilting.h"

namespace gramloom {
namespace {

/// Grains of about 8 pixels with noise on them.
Image grains(int side) {
  Image image(side, side, 3);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      Random grain(1, static_cast<std::uint64_t>((x + y % 16 / 8 * 4) / 8 * 64 + y / 8));
      Random noise(2, static_cast<std::uint64_t>(y * side + x));
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = 0.7f * grain.uniform() + 0.3f * noise.uniform();
    }
  return image;
}

template <class Params>
void run(benchmark::State& state, const Params& params) {
  const int side = static_cast<int>(state.range(0));
  const Image exemplar = grains(static_cast<int>(state.range(1)));
  for (auto _ : state)
    benchmark::DoNotOptimize(
        synthesise(params, {{{exemplar}}, {{side, side}, Tile::none}, Random(1)}, {})
            .image.pixels.data());
}

void quilting(benchmark::State& state) { run(state, QuiltingParams{}); }
void patchmatch(benchmark::State& state) { run(state, PatchmatchParams{}); }

BENCHMARK(quilting)
    ->ArgNames({"texture", "exemplar"})
    ->ArgsProduct({{128, 256}, {256}})
    ->ArgsProduct({{512}, {200, 256, 300, 400}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(patchmatch)
    ->ArgNames({"texture", "exemplar"})
    ->ArgsProduct({{128, 256, 512, 1024}, {256}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace gramloom
