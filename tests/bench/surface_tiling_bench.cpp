// Stochastic tiling of a picture of 512², on every core: more than 20 million pixels a second on
// two cores is what 16384² is to take.
#include <benchmark/benchmark.h>

#include "surface/stochastic_tiling.h"

namespace gramloom {
namespace {

Image grain(int side) {
  Image image(side, side, 3);
  Random random(1);
  for (float& value : image.pixels) value = random.uniform();
  return image;
}

// Rows as `gramloom tile` asks for them.
void rows(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0));
  const TilingParams params{.blend = static_cast<TileBlend>(state.range(1)),
                            .rotation = static_cast<double>(state.range(2))};
  const StochasticTiling tiling({grain(512)}, params, Random(1));
  std::vector<float> pixels(static_cast<std::size_t>(64 * width * 3));
  int y = 0;
  for (auto _ : state) {
    tiling.rows(y, 64, width, pixels.data());
    benchmark::DoNotOptimize(pixels.data());
    y += 64;
  }
  state.SetItemsProcessed(state.iterations() * 64 * width);  // pixels
}
BENCHMARK(rows)
    ->ArgNames({"width", "contrast", "rotation"})
    ->Args({16384, 0, 0})
    ->Args({16384, 1, 0})
    ->Args({2048, 0, 180})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

// What is made of an exemplar before its first row.
void made_ready(benchmark::State& state) {
  const Exemplar exemplar{grain(static_cast<int>(state.range(0)))};
  for (auto _ : state)
    benchmark::DoNotOptimize(StochasticTiling(exemplar, TilingParams(), Random(1)));
}
BENCHMARK(made_ready)->Arg(512)->Arg(2048)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace gramloom
