#include "core/portable_math.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace gramloom {
namespace {

double uniform(Random& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random.bits()) + 0.5) * 0x1p-32;
}

TEST(PortableMath, AgreesWithTheMathematicsLibrary) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double angle = uniform(random, -1000, 1000);
    EXPECT_NEAR(portable::sin(angle), std::sin(angle), 2e-15) << angle;
    EXPECT_NEAR(portable::cos(angle), std::cos(angle), 2e-15) << angle;
    const double x = uniform(random, -700, 700);
    EXPECT_NEAR(portable::exp(x) / std::exp(x), 1, 2e-15) << x;
    const double base = uniform(random, 0, 100), power = uniform(random, -20, 20);
    EXPECT_NEAR(portable::pow(base, power) / std::pow(base, power), 1, 1e-13)
        << base << " " << power;
    EXPECT_NEAR(portable::log(base), std::log(base), 4e-15) << base;
    const double a = uniform(random, -3, 3), b = uniform(random, -3, 3);
    EXPECT_NEAR(portable::atan2(a, b), std::atan2(a, b), 2e-15) << a << " " << b;
  }
}

TEST(PortableMath, TheInverseNormalDistributionIsOneOfErf) {
  for (double p = 0.0005; p < 1; p += 0.0005)
    EXPECT_NEAR(0.5 * std::erfc(-portable::inverse_normal(p) / std::sqrt(2.0)), p, 1e-9) << p;
  EXPECT_EQ(portable::inverse_normal(0.5), 0);
  EXPECT_NEAR(portable::inverse_normal(1e-9), -5.9978070150076869, 1e-7);
}

TEST(PortableMath, SpecialValues) {
  EXPECT_EQ(portable::sin(0), 0);
  EXPECT_EQ(portable::cos(0), 1);
  EXPECT_EQ(portable::exp(0), 1);
  EXPECT_EQ(portable::log(1), 0);
  EXPECT_EQ(portable::exp(-1000), 0);
  EXPECT_TRUE(std::isinf(portable::exp(710)));
  EXPECT_EQ(portable::pow(0, 3), 0);
  EXPECT_EQ(portable::pow(0, 0), 1);
  EXPECT_EQ(portable::atan2(0, 0), 0);
  EXPECT_DOUBLE_EQ(portable::atan2(0, -1), portable::pi);
  EXPECT_DOUBLE_EQ(portable::atan2(1, 0), portable::pi / 2);
  EXPECT_DOUBLE_EQ(portable::atan2(-1, 0), -portable::pi / 2);
}

}  // namespace
}  // namespace gramloom
