// Each method that makes a texture from an exemplar: N × N pixels, RGB, from one of half the side.
#include <benchmark/benchmark.h>

#include <cmath>

#include "classic/histogram.h"
#include "classic/markov.h"
#include "classic/phase.h"
#include "classic/pyramid.h"

namespace gramloom {
namespace {

Image grain(int side) {
  Image image(side, side, 3);
  Random random(1);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = 0.5f + 0.2f * std::sin(0.3f * static_cast<float>(x + c * y)) +
                            0.1f * random.uniform(-1, 1);
  return image;
}

template <class Params>
void synthesis(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const Image exemplar = grain(side / 2);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        synthesise(Params{}, {{{exemplar}}, Target{{side, side}}, Random(1)}, Control{}));
}

#define GRAMLOOM_BENCHMARK(Params)    \
  BENCHMARK(synthesis<Params>)        \
      ->RangeMultiplier(2)            \
      ->Range(128, 512)               \
      ->Unit(benchmark::kMillisecond) \
      ->MeasureProcessCPUTime()       \
      ->UseRealTime()

GRAMLOOM_BENCHMARK(HistogramParams);
GRAMLOOM_BENCHMARK(MarkovParams);
GRAMLOOM_BENCHMARK(PhaseParams);
GRAMLOOM_BENCHMARK(PyramidParams);

}  // namespace
}  // namespace gramloom
