// A ball of stones under a lamp, 512 × 512 with 16 samples a pixel, on every core: displaced and
// lit it is to take 2 seconds at most on two cores.
#include <benchmark/benchmark.h>

#include <cmath>

#include "surface/preview.h"

namespace gramloom {
namespace {

PreviewMaterial stones(int side) {
  PreviewMaterial m;
  m.colour = Image(side, side, 3);
  Image& height = m.maps["height"] = Image(side, side, 1);
  const float wave = 2 * 3.14159265f * 6 / static_cast<float>(side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const float h = 0.5f + 0.25f * std::sin(wave * static_cast<float>(x)) +
                      0.25f * std::cos(wave * static_cast<float>(y));
      *height.at(x, y) = h;
      for (int c = 0; c < 3; ++c) m.colour.at(x, y)[c] = 0.3f + 0.5f * h;
    }
  return m;
}

void ball(benchmark::State& state) {
  PreviewParams params;
  params.displacement = 0.01 * static_cast<double>(state.range(0));
  params.samples = static_cast<int>(state.range(1));
  const PreviewMaterial material = stones(512);
  for (auto _ : state) benchmark::DoNotOptimize(render_preview(params, {&material, 1}, {}, {}));
}
BENCHMARK(ball)
    ->ArgNames({"displaced_percent", "samples"})
    ->Args({8, 4})
    ->Args({0, 4})
    ->Args({8, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace gramloom
