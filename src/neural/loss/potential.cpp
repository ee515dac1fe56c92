#include "neural/loss/potential.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/simd.h"

namespace gramloom::neural {

namespace {

constexpr int at_once = 256;  // values
constexpr int lanes = 16;

using Range = Potential::Range;

GRAMLOOM_SIMD Range find_range(const float* values, std::size_t count) {
  float low[lanes], high[lanes];
  std::fill_n(low, lanes, values[0]);
  std::fill_n(high, lanes, values[0]);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int lane = 0; lane < lanes; ++lane) {
      const float value = values[i + static_cast<std::size_t>(lane)];
      low[lane] = value < low[lane] ? value : low[lane];
      high[lane] = value > high[lane] ? value : high[lane];
    }
  for (; i < count; ++i) {
    low[0] = std::min(low[0], values[i]);
    high[0] = std::max(high[0], values[i]);
  }
  return {*std::min_element(low, low + lanes), *std::max_element(high, high + lanes)};
}

// 0 below the range, 1 to `bins` in it, bins + 1 above.
GRAMLOOM_INLINE int bin_of(float value, float low, float per_bin) {
  const float place = (value - low) * per_bin + 1;
  const float from = place > 0 ? place : 0;
  return static_cast<int>(from < Potential::bins + 1 ? from : Potential::bins + 1);
}

GRAMLOOM_SIMD void find_bins(const float* values, int count, float low, float per_bin,
                             std::int32_t* bins) {
  for (int i = 0; i < count; ++i) bins[i] = bin_of(values[i], low, per_bin);
}

GRAMLOOM_SIMD void look_up(float* values, std::size_t count, float low, float per_bin,
                           const float* slopes, float weight) {
  for (std::size_t i = 0; i < count; ++i)
    values[i] = weight * slopes[bin_of(values[i], low, per_bin)];
}

// Bins per unit of a range that is one.
float per_bin_of(Range range) {
  const float width = (range.high - range.low) / Potential::bins;
  return (1 - 1e-6f) / width;  // the highest value lies in the last bin
}

}  // namespace

Range Potential::range_of(std::span<const float> values) {
  if (values.empty())
    return {std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  return find_range(values.data(), values.size());
}

Potential::Counts Potential::count(std::span<const float> values, Range range) {
  std::array<std::int32_t, bins + 2> counts{}, others{};  // neighbours are often alike: the next
  std::int32_t found[at_once];                            // one need not wait for the last count
  const float per_bin = per_bin_of(range);
  for (std::size_t first = 0; first < values.size(); first += at_once) {
    const auto some = static_cast<int>(std::min<std::size_t>(at_once, values.size() - first));
    find_bins(values.data() + first, some, range.low, per_bin, found);
    int i = 0;
    for (; i + 1 < some; i += 2) {
      ++counts[static_cast<std::size_t>(found[i])];
      ++others[static_cast<std::size_t>(found[i + 1])];
    }
    if (i < some) ++counts[static_cast<std::size_t>(found[i])];
  }
  Counts result;
  for (std::size_t b = 0; b < bins; ++b) result[b] = counts[b + 1] + others[b + 1];
  return result;
}

Potential::Potential(std::span<const float> values, std::span<const float> goal) {
  const Range own = range_of(values), wanted = range_of(goal);
  const Range range{std::min(own.low, wanted.low), std::max(own.high, wanted.high)};
  low_ = range.low;
  if (range.high > range.low) *this = Potential(range, count(values, range), count(goal, range));
}

Potential::Potential(Range range, const Counts& values, const Counts& goal) : low_(range.low) {
  if (!(range.high > range.low)) return;  // all are equal
  per_bin_ = per_bin_of(range);
  const float width = (range.high - range.low) / bins;
  // What part of the goal lies below a bin's ends, less that of the values: whole numbers, so that
  // equal samples have no slope. In between it is linear; the slope is its mean sign.
  const std::int64_t size = std::accumulate(values.begin(), values.end(), std::int64_t{0}),
                     goal_size = std::accumulate(goal.begin(), goal.end(), std::int64_t{0});
  const auto scale = static_cast<double>(size) * static_cast<double>(goal_size);
  std::int64_t below = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    const std::int64_t next = below + goal[b] * size - values[b] * goal_size;
    const double from = static_cast<double>(below) / scale, to = static_cast<double>(next) / scale;
    below = next;
    const double sizes = std::abs(from) + std::abs(to);
    if (sizes == 0) continue;
    slopes_[b + 1] = static_cast<float>((from + to) / sizes);
    const double mean = (from * from + to * to + 2 * std::max(0.0, from * to)) / (2 * sizes);
    distance_ += mean * double{width};
  }
}

void Potential::to_slopes(std::span<float> values, float weight) const {
  look_up(values.data(), values.size(), low_, per_bin_, slopes_.data(), weight);
}

}  // namespace gramloom::neural
