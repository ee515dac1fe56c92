#include "neural/flow/prices.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "signal/blur.h"

namespace gramloom::neural {

namespace {

constexpr std::int64_t most_queries = 8192;  // more change no price to speak of
constexpr double least_use = 0.05;
constexpr double slowing = 0.7;  // of the rate from one repetition to the next

// Squared, in the first `dimensions` alone; `square` is that of the scaled reference.
double distance_in(std::int64_t dimensions, const float* query, const float* reference,
                   float square, float scale) {
  double sum = square;
  for (std::int64_t d = 0; d < dimensions; ++d)
    sum += double{query[d]} * query[d] - 2.0 * scale * query[d] * reference[d];
  return sum;
}

Vectors some_of(const Vectors& queries, Random random) {
  if (queries.count <= most_queries) return queries;
  Vectors some(most_queries, queries.dimensions);
  for (std::int64_t i = 0; i < most_queries; ++i)
    std::copy_n(queries.at(random.below(static_cast<std::uint32_t>(queries.count))),
                queries.dimensions, some.at(i));
  return some;
}

}  // namespace

void update_prices(Prices prices, const std::vector<PatchPlace>& places, const Vectors& queries,
                   const Vectors& references, const std::vector<float>& offsets, float scale,
                   const PriceSteps& steps, Random random) {
  const Vectors some = some_of(queries, random);
  const auto index = [&](PatchPlace p) {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(prices.places.width) +
           static_cast<std::size_t>(p.x);
  };
  const double deviation = std::max(0.3, steps.smoothing);
  Image there(prices.places, 1);
  for (const PatchPlace p : places) there.pixels[index(p)] = 1;
  there = blurred(there, deviation, Tile::none);
  double squares = 0;
  for (const float v : some.values) squares += static_cast<double>(v) * v;

  double mean_distance = 0, rate = steps.rate;
  for (int i = 0; i < steps.repetitions; ++i, rate *= slowing) {
    std::vector<float> with_price = offsets;
    for (std::size_t r = 0; r < places.size(); ++r)
      with_price[r] += prices.values[index(places[r])];
    const Neighbours nearest = nearest_references(some, references, with_price, scale, 1);
    Image use(prices.places, 1);
    double costs = 0;
    const float one = static_cast<float>(places.size()) / static_cast<float>(some.count);
    for (std::size_t q = 0; q < nearest.cost.size(); ++q) {
      const std::size_t at = index(places[static_cast<std::size_t>(nearest.reference[q])]);
      use.pixels[at] += one;
      costs += static_cast<double>(nearest.cost[q]) - prices.values[at];
    }
    if (i == 0) {
      double sum = squares + costs;
      if (steps.dimensions > 0) {  // not how unlike guides are: it may be without measure
        sum = 0;
        for (std::int64_t q = 0; q < some.count; ++q) {
          const auto r = nearest.reference[static_cast<std::size_t>(q)];
          sum += distance_in(steps.dimensions, some.at(q), references.at(r),
                             offsets[static_cast<std::size_t>(r)], scale);
        }
      }
      mean_distance = std::max(0.0, sum / static_cast<double>(some.count));
    }
    use = blurred(use, deviation, Tile::none);
    double sum = 0;
    for (std::size_t p = 0; p < use.pixels.size(); ++p) {
      const double used = use.pixels[p] / (there.pixels[p] + 1e-9);
      // Of places far from all references nothing is known.
      const double change =
          there.pixels[p] > 1e-6f ? std::clamp(std::log(std::max(used, least_use)), -2.0, 2.0) : 0;
      prices.values[p] += static_cast<float>(rate * mean_distance * change);
      sum += prices.values[p];
    }
    const auto mean = static_cast<float>(sum / static_cast<double>(use.pixels.size()));
    for (std::size_t p = 0; p < use.pixels.size(); ++p) prices.values[p] -= mean;
  }
}

}  // namespace gramloom::neural
