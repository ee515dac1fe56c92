#include "signal/window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "signal/mirror.h"

namespace gramloom {
namespace {

TEST(Window, OfAHalfIsHanns) {
  for (const int length : {1, 2, 7, 64}) {
    const auto window = raised_cosine(length, 0.5);
    ASSERT_EQ(window.size(), static_cast<std::size_t>(length));
    for (int i = 0; i < length; ++i)
      EXPECT_NEAR(window[static_cast<std::size_t>(i)],
                  std::pow(std::sin(std::numbers::pi * (i + 0.5) / length), 2), 1e-12);
  }
}

TEST(Window, FadesAtItsEndsAlone) {
  EXPECT_EQ(raised_cosine(5, 0), std::vector<double>(5, 1.0));
  const auto window = raised_cosine(100, 0.1);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_NEAR(window[i], window[99 - i], 1e-12);
    if (i < 10) {
      EXPECT_LT(window[i], window[i + 1]);
    } else {
      EXPECT_EQ(window[i], 1);
    }
  }
}

TEST(Window, HasTheEnergyThatIsAskedFor) {
  const auto window = scaled_to_energy(raised_cosine(37, 0.3), 80);
  EXPECT_NEAR(std::inner_product(window.begin(), window.end(), window.begin(), 0.0), 80, 1e-4);
}

TEST(Mirror, GoesBackAndForthAndRepeatsTheLastPixel) {
  const std::vector<int> expected{0, 1, 2, 2, 1, 0, 0, 1, 2};
  for (int i = 0; i < 9; ++i) EXPECT_EQ(mirrored(i, 3), expected[static_cast<std::size_t>(i)]);
  EXPECT_EQ(mirrored(5, 1), 0);
  Image image(2, 1, 1);
  image.pixels = {3, 4};
  const Image longer = at_least(image, 5);
  EXPECT_EQ(longer.size(), (Size{5, 5}));
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(*longer.at(x, y), x % 4 == 0 || x == 3 ? 3 : 4) << x;
}

}  // namespace
}  // namespace gramloom
