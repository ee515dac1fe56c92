#include "signal/sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"

namespace gramloom {
namespace {

// Normal numbers, some of them very large, very small, equal or −0.
std::vector<float> numbers(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> values(count);
  for (float& v : values) {
    v = random.normal();
    if (random.below(10) == 0) v = std::round(v);
    if (random.below(50) == 0) v *= 1e30f;
    if (random.below(50) == 0) v *= 1e-30f;
    if (random.below(100) == 0) v *= 1e-40f;
    if (random.below(100) == 0) v = -0.0f;
  }
  return values;
}

// Few, as many as stay in the cache, and more, of which each digit has its own way.
const std::vector<std::size_t> counts{0, 1, 2, 100, 5000, 1 << 18, (1 << 18) + 1, 700'001};

TEST(Sorter, SortsAsTheStandardLibraryDoes) {
  Sorter sorter;  // one for all: what it keeps does not matter
  for (const std::size_t count : counts) {
    auto values = numbers(count, count), expected = values;
    std::sort(expected.begin(), expected.end());
    sorter.sort(values);
    EXPECT_EQ(values, expected) << count;  // −0 equals 0
  }
}

TEST(Sorter, RanksAreStable) {
  Sorter sorter;
  for (const std::size_t count : counts) {
    const auto values = numbers(count, count + 1);
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return values[a] < values[b]; });
    const auto ranked = sorter.rank(values);
    ASSERT_EQ(ranked.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(ranked[i].place, order[i]) << i << " of " << count;
      ASSERT_EQ(ranked[i].value(), values[order[i]]);
    }
  }
}

TEST(Sorter, OfEqualValuesTheOrderStays) {
  const std::vector<float> values(300'000, -2.5f);
  Sorter sorter;
  const auto ranked = sorter.rank(values);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(ranked[i].place, i);
}

}  // namespace
}  // namespace gramloom
