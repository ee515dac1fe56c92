// All scores of an N × N picture against an exemplar of the same size, RGB, on one thread.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/random.h"
#include "core/threads.h"
#include "metrics/scores.h"

namespace gramloom {
namespace {

// Waves under grain, shifted by the seed: neither a copy nor another texture.
Image texture(int side, std::uint64_t seed) {
  Image image(side, side, 3);
  Random random(seed);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] =
            0.5f +
            0.2f * std::sin(0.3f * static_cast<float>(x + c * y) + static_cast<float>(seed)) +
            0.1f * random.uniform(-1, 1);
  return image;
}

void all_scores(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  set_thread_count(1);
  const Image exemplar = texture(side, 1), image = texture(side, 2);
  for (auto _ : state) benchmark::DoNotOptimize(score(exemplar, image, Tile::both));
}
BENCHMARK(all_scores)->Arg(256)->Arg(1024)->Unit(benchmark::kSecond);

void diversity_of_four(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  set_thread_count(1);
  std::vector<Image> seeds;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) seeds.push_back(texture(side, seed));
  for (auto _ : state) benchmark::DoNotOptimize(diversity(seeds));
}
BENCHMARK(diversity_of_four)->Arg(256)->Arg(1024)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace gramloom
