#include "procedural/pack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gramloom {
namespace {

TEST(Pack, FloorRoundsDownNegativeNumbersToo) {
  for (const float v : {-2.5f, -2.0f, -1e-6f, -0.0f, 0.0f, 0.75f, 1.0f, 123456.7f})
    EXPECT_EQ(floor(splat(v))[0], std::floor(v)) << v;
  EXPECT_FLOAT_EQ(fraction(splat(-0.25f))[0], 0.75f);
}

TEST(Pack, ElementaryFunctionsAreAccurate) {
  for (int i = -4000; i <= 4000; ++i) {
    const float x = static_cast<float>(i) * 0.005f;
    const auto d = static_cast<double>(x);
    EXPECT_NEAR(sin_turns(splat(x))[0], std::sin(2 * std::numbers::pi * d), 1e-6) << x;
    EXPECT_NEAR(cos_turns(splat(x))[0], std::cos(2 * std::numbers::pi * d),
                1e-6 + 1e-6 * std::abs(d))
        << x;
    EXPECT_NEAR(sin(splat(x))[0], std::sin(d), 1e-6 + 1e-6 * std::abs(d)) << x;
    EXPECT_NEAR(exp2(splat(x))[0] / std::exp2(d), 1, 1e-6) << x;
    EXPECT_NEAR(exp(splat(x))[0] / std::exp(d), 1, 4e-6) << x;
    if (i > 0) {
      EXPECT_NEAR(log2(splat(x))[0], std::log2(d), 2e-6) << x;
      EXPECT_NEAR(pow(splat(x), 2.5f)[0] / std::pow(d, 2.5), 1, 1e-5) << x;
      EXPECT_EQ(sqrt(splat(x))[0], std::sqrt(x)) << x;
    }
  }
  EXPECT_EQ(pow(splat(0), 6)[0], 0);
  EXPECT_EQ(exp2(splat(3))[0], 8);
}

TEST(Pack, StepsAreAsTheirFormulas) {
  EXPECT_EQ(smoothstep(1, 3, splat(0))[0], 0);
  EXPECT_EQ(smoothstep(1, 3, splat(2))[0], 0.5f);
  EXPECT_EQ(smoothstep(1, 3, splat(4))[0], 1);
  EXPECT_EQ(smoothstep(3, 1, splat(4))[0], 0);
  EXPECT_EQ(linstep(1, 3, splat(1.5f))[0], 0.25f);
}

TEST(Pack, HashedNumbersAreUniform) {
  double sum = 0, square_sum = 0;
  constexpr int count = 40000;
  for (std::uint32_t i = 0; i < count; i += 2)
    for (std::uint32_t which = 1; which <= 2; ++which) {
      const auto v = static_cast<double>(unit_float(hash(Uints{} + i), which)[0]);
      ASSERT_GE(v, 0);
      ASSERT_LT(v, 1);
      sum += v;
      square_sum += v * v;
    }
  EXPECT_NEAR(sum / count, 0.5, 0.01);
  EXPECT_NEAR(square_sum / count, 1.0 / 3, 0.01);
}

}  // namespace
}  // namespace gramloom
