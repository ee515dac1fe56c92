#include "neural/loss/wasserstein.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "core/simd.h"
#include "core/threads.h"
#include "neural/normal_numbers.h"
#include "signal/quantile.h"
#include "signal/sort.h"

namespace gramloom::neural {

namespace {

constexpr std::int64_t ranks_at_once = 256;

// Values of consecutive ranks against the goal's at these ranks: `slopes` become `slope` where the
// value is above its goal, −slope below, 0 where it is there. The sum of the distances.
GRAMLOOM_SIMD double compare(const RankedValue* ranked, const float* goals, std::int64_t count,
                             float slope, float* slopes) {
  constexpr int lanes = 8;
  float distances[ranks_at_once];
  for (std::int64_t i = 0; i < count; ++i) {
    const float difference = ranked[i].value() - goals[i];
    distances[i] = std::abs(difference);
    slopes[i] = (difference > 0 ? slope : 0.0f) - (difference < 0 ? slope : 0.0f);
  }
  double sums[lanes] = {};
  std::int64_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int lane = 0; lane < lanes; ++lane) sums[lane] += static_cast<double>(distances[i + lane]);
  for (; i < count; ++i) sums[0] += static_cast<double>(distances[i]);
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

// The distances of one row's values from the goal's, summed; the values become slopes.
double move_to_slopes(std::span<float> values, std::span<const float> goal, float slope,
                      Sorter& sorter) {
  const auto ranked = sorter.rank(values);
  const Quantiles quantiles(goal, values.size());
  const auto count = static_cast<std::int64_t>(values.size());
  float goals[ranks_at_once], slopes[ranks_at_once];
  double sum = 0;
  for (std::int64_t first = 0; first < count; first += ranks_at_once) {
    const std::int64_t some = std::min(ranks_at_once, count - first);
    quantiles.get(static_cast<std::size_t>(first), {goals, static_cast<std::size_t>(some)});
    const RankedValue* own = ranked.data() + first;
    sum += compare(own, goals, some, slope, slopes);
    for (std::int64_t i = 0; i < some; ++i) values[own[i].place] = slopes[i];
  }
  return sum;
}

std::span<float> row_of(const at::Tensor& rows, std::int64_t r) {
  return {rows.data_ptr<float>() + r * rows.size(1), static_cast<std::size_t>(rows.size(1))};
}

}  // namespace

at::Tensor random_directions(Random random, std::int64_t count, std::int64_t length) {
  at::Tensor result = normal_numbers(random, {count, length});
  return result.div_(result.norm(2, 1, true));
}

void sort_rows(at::Tensor& rows) {
  parallel_for(rows.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
    Sorter sorter;
    for (std::int64_t r = begin; r < end; ++r) sorter.sort(row_of(rows, r));
  });
}

double wasserstein(at::Tensor& rows, const at::Tensor& target, double weight) {
  const float slope = 1.0f / static_cast<float>(rows.numel()) * static_cast<float>(weight);
  std::vector<double> sums(static_cast<std::size_t>(rows.size(0)));
  parallel_for(rows.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
    Sorter sorter;
    for (std::int64_t r = begin; r < end; ++r)
      sums[static_cast<std::size_t>(r)] =
          move_to_slopes(row_of(rows, r), row_of(target, r), slope, sorter);
  });
  double total = 0;
  for (const double sum : sums) total += sum;
  return total / static_cast<double>(rows.numel());
}

double distance_from_mean(const at::Tensor& rows) {
  std::vector<double> distances(static_cast<std::size_t>(rows.size(0)));
  const std::int64_t count = rows.size(1);
  parallel_for(rows.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r < end; ++r) {
      const float* values = rows.data_ptr<float>() + r * count;
      const double mean = std::accumulate(values, values + count, 0.0) / static_cast<double>(count);
      double sum = 0;
      for (std::int64_t i = 0; i < count; ++i) sum += std::abs(values[i] - mean);
      distances[static_cast<std::size_t>(r)] = sum / static_cast<double>(count);
    }
  });
  return std::accumulate(distances.begin(), distances.end(), 0.0);
}

}  // namespace gramloom::neural
