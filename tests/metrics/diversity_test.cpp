#include <gtest/gtest.h>

#include <vector>

#include "metrics/pictures.h"
#include "metrics/scores.h"

namespace gramloom {
namespace {

TEST(Diversity, OfEqualShiftedAndUnlikeImages) {
  const Image a = pebbles(1), b = pebbles(2), c = pebbles(3);
  EXPECT_NEAR(diversity(std::vector{a, a}), 0, 1e-5);
  EXPECT_LT(diversity(std::vector{a, window(a, 40, 70, a.size())}), 0.05);
  EXPECT_GT(diversity(std::vector{a, b, c}), 0.4);
  EXPECT_LT(diversity(std::vector{a, a, b}), diversity(std::vector{a, b, c}));
  EXPECT_THROW(diversity(std::vector{a}), Error);
  EXPECT_THROW(diversity(std::vector{a, Image(8, 8, 1)}), Error);
}

}  // namespace
}  // namespace gramloom
