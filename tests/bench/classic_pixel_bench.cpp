#include <benchmark/benchmark.h>

#include "classic/pixel.h"

namespace gramloom {
namespace {

/// Grains of about 8 pixels, 256².
Image exemplar() {
  Image image(256, 256, 3);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      Random grain(1, static_cast<std::uint64_t>((x + y % 16 / 8 * 4) / 8 * 64 + y / 8));
      Random pixel(2, static_cast<std::uint64_t>(y * 256 + x));
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = 0.7f * grain.uniform() + 0.3f * pixel.uniform();
    }
  return image;
}

void pixel(benchmark::State& state) {
  PixelParams params;
  params.algorithm = static_cast<PixelAlgorithm>(state.range(0));
  const int side = static_cast<int>(state.range(1));
  const Image from = exemplar();
  for (auto _ : state)
    benchmark::DoNotOptimize(
        synthesise(params, {{{from}}, {{side, side}, Tile::both}, Random(1)}, {})
            .image.pixels.data());
  state.SetLabel(std::string(to_word(params.algorithm)));
}
BENCHMARK(pixel)
    ->ArgsProduct({{0, 1, 2}, {128, 256, 512}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace gramloom
