#include "neural/loss/wasserstein.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "core/threads.h"
#include "neural/normal_numbers.h"

namespace gramloom::neural {

namespace {

// A value as an integer of the same order, and where it came from.
struct Key {
  std::uint32_t order;
  std::uint32_t index;
};

std::uint32_t order_of(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

float value_of(std::uint32_t order) {
  return std::bit_cast<float>(order & 0x80000000u ? order & 0x7FFFFFFFu : ~order);
}

std::uint32_t order_of(Key key) { return key.order; }
std::uint32_t order_of(std::uint32_t order) { return order; }

// Radix sort by three digits of 11 bits: several times as fast as a sort that compares.
template <class T>
void sort(std::vector<T>& items, std::vector<T>& spare) {
  constexpr std::uint32_t digit_bits = 11, size = 1u << digit_bits;
  constexpr std::size_t digits = 3;
  std::array<std::array<std::uint32_t, size>, digits> place{};
  for (const T& item : items)
    for (std::size_t d = 0; d < digits; ++d)
      ++place[d][(order_of(item) >> (digit_bits * d)) % size];
  spare.resize(items.size());
  for (std::size_t d = 0; d < digits; ++d) {
    std::uint32_t sum = 0;
    for (auto& count : place[d]) sum += std::exchange(count, sum);
    for (const T& item : items)
      spare[place[d][(order_of(item) >> (digit_bits * d)) % size]++] = item;
    items.swap(spare);
  }
}

// The value of rank i among `count` in `available` ascending values.
float at_rank(const float* sorted, std::int64_t available, std::int64_t i, std::int64_t count) {
  if (available == count) return sorted[i];
  const double rank =
      (static_cast<double>(i) + 0.5) * static_cast<double>(available) / static_cast<double>(count) -
      0.5;
  const double inside = std::clamp(rank, 0.0, static_cast<double>(available - 1));
  const auto below = static_cast<std::int64_t>(inside);
  const auto above = std::min(below + 1, available - 1);
  const auto part = static_cast<float>(inside - static_cast<double>(below));
  return sorted[below] + part * (sorted[above] - sorted[below]);
}

}  // namespace

at::Tensor random_directions(Random random, std::int64_t count, std::int64_t length) {
  at::Tensor result = normal_numbers(random, {count, length});
  return result.div_(result.norm(2, 1, true));
}

void sort_rows(at::Tensor& rows) {
  const std::int64_t count = rows.size(1);
  parallel_for(rows.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint32_t> items(static_cast<std::size_t>(count)), spare;
    for (std::int64_t r = begin; r < end; ++r) {
      float* values = rows.data_ptr<float>() + r * count;
      std::transform(values, values + count, items.begin(), [](float v) { return order_of(v); });
      sort(items, spare);
      std::transform(items.begin(), items.end(), values, value_of);
    }
  });
}

double wasserstein(at::Tensor& rows, const at::Tensor& target) {
  const std::int64_t count = rows.size(1), available = target.size(1);
  const float weight = 1.0f / static_cast<float>(rows.numel());
  std::vector<double> sums(static_cast<std::size_t>(rows.size(0)));
  parallel_for(rows.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
    std::vector<Key> keys(static_cast<std::size_t>(count)), spare;
    for (std::int64_t r = begin; r < end; ++r) {
      float* values = rows.data_ptr<float>() + r * count;
      const float* goal = target.data_ptr<float>() + r * available;
      for (std::size_t i = 0; i < keys.size(); ++i)
        keys[i] = {order_of(values[i]), static_cast<std::uint32_t>(i)};
      sort(keys, spare);
      double sum = 0;
      for (std::int64_t i = 0; i < count; ++i) {
        const Key key = keys[static_cast<std::size_t>(i)];
        const float difference = value_of(key.order) - at_rank(goal, available, i, count);
        sum += std::abs(difference);
        values[key.index] = difference > 0 ? weight : difference < 0 ? -weight : 0.0f;
      }
      sums[static_cast<std::size_t>(r)] = sum;
    }
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
