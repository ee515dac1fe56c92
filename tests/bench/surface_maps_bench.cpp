// Maps of an N × N height map, on every core. A normal map of 4096² is to take half a second at
// most on two cores.
#include <benchmark/benchmark.h>

#include <cmath>

#include "surface/height_from_normals.h"
#include "surface/normal_map.h"
#include "surface/relief_maps.h"

namespace gramloom {
namespace {

Image waves(int side) {
  Image height(side, side, 1);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      *height.at(x, y) = 0.5f + 0.25f * std::sin(0.05f * static_cast<float>(x)) +
                         0.25f * std::cos(0.07f * static_cast<float>(y));
  return height;
}

void normal_map(benchmark::State& state) {
  const Image height = waves(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(normals_from_height(height, 8, Tile::both));
}
BENCHMARK(normal_map)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

void occlusion_map(benchmark::State& state) {
  const Image height = waves(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(ambient_occlusion(height, 8, 32, 8, Tile::both));
}
BENCHMARK(occlusion_map)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

void curvature_map(benchmark::State& state) {
  const Image height = waves(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(curvature(height, 8, 4, 2, Tile::both));
}
BENCHMARK(curvature_map)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

void height_map(benchmark::State& state) {
  const Image normals = normals_from_height(waves(static_cast<int>(state.range(0))), 8, Tile::both);
  const Tile tile = state.range(1) ? Tile::both : Tile::none;
  for (auto _ : state) benchmark::DoNotOptimize(height_from_normals(normals, 8, tile));
}
BENCHMARK(height_map)
    ->Args({1024, 1})
    ->Args({1024, 0})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace gramloom
