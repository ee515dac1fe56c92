#include "signal/quantile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace gramloom {
namespace {

using testing::ElementsAre;

std::vector<double> all(const std::vector<float>& sorted, std::size_t ranks) {
  const Quantiles quantile(sorted, ranks);
  std::vector<double> values;
  for (std::size_t i = 0; i < ranks; ++i) values.push_back(quantile(i));
  return values;
}

TEST(Quantiles, KnownByHand) {
  EXPECT_THAT(all({0, 1}, 4), ElementsAre(0, 0.25, 0.75, 1));
  EXPECT_THAT(all({0, 1, 2, 3}, 2), ElementsAre(0.5, 2.5));
  EXPECT_THAT(all({2, 5, 9}, 3), ElementsAre(2, 5, 9));
  EXPECT_THAT(all({7}, 3), ElementsAre(7, 7, 7));
  EXPECT_THAT(all({1, 2, 6}, 1), ElementsAre(2));
}

TEST(Quantiles, ManyAtOnceAreThoseOneByOne) {
  std::vector<float> sorted;
  for (int i = 0; i < 1009; ++i) sorted.push_back(static_cast<float>(i * i) / 777.0f - 3);
  for (const std::size_t ranks : {1u, 5u, 800u, 1009u, 5000u, 70'001u}) {
    const Quantiles quantile(sorted, ranks);
    for (std::size_t first = 0; first < ranks; first += 333) {
      std::vector<float> some(std::min<std::size_t>(333, ranks - first));
      quantile.get(first, some);
      for (std::size_t i = 0; i < some.size(); ++i)
        ASSERT_EQ(some[i], static_cast<float>(quantile(first + i))) << first + i << " of " << ranks;
    }
  }
}

}  // namespace
}  // namespace gramloom
