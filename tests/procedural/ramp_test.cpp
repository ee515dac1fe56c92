#include "procedural/ramp.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace gramloom {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::vector<double> colours{0, 0.5, 1, 1, 0.25, 0, 0.5, 0.5, 0.5, 0.1, 0.2, 0.3};
const std::vector<double> positions{0.1, 0.3, 0.35, 0.9};

float red(const Ramp& ramp, double t) { return colour_at(ramp, splat(static_cast<float>(t))).r[0]; }

TEST(Ramp, PassesThroughItsColoursAndIsConstantBeyond) {
  for (const Curve curve : {Curve::linear, Curve::spline}) {
    const Ramp ramp = make_ramp("colours", colours, positions, curve);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(red(ramp, positions[k]), colours[3 * k], 1e-5);
    EXPECT_NEAR(red(ramp, -5), 0, 1e-6);
    EXPECT_NEAR(red(ramp, 5), 0.1, 1e-5);
  }
}

TEST(Ramp, IsLinearBetweenColours) {
  const Ramp ramp = make_ramp("colours", colours, positions);
  EXPECT_NEAR(red(ramp, 0.15), 0.25, 1e-5);
  EXPECT_NEAR(red(make_ramp("colours", {0, 0, 0, 1, 1, 1, 0, 0, 0}), 0.25), 0.5, 1e-6);
}

TEST(Ramp, ASplineHasNoCorners) {
  const Ramp ramp = make_ramp("colours", colours, positions, Curve::spline);
  for (const double t : {0.3, 0.35}) {
    constexpr double h = 1e-3;
    const double left = (red(ramp, t) - red(ramp, t - h)) / h,
                 right = (red(ramp, t + h) - red(ramp, t)) / h;
    EXPECT_NEAR(left, right, 0.9);  // slopes of 5 and −10 where the ramp is linear
  }
}

TEST(Ramp, OneColourIsItselfEverywhere) {
  const Ramp ramp = make_ramp("colours", {0.2, 0.3, 0.4});
  EXPECT_FLOAT_EQ(red(ramp, 0), 0.2f);
  EXPECT_FLOAT_EQ(red(ramp, 1), 0.2f);
}

TEST(Ramp, WrongListsAreErrors) {
  EXPECT_THAT(
      [] {
        make_ramp("colours", {1, 2});
      },
      ThrowsMessage<ConfigError>(HasSubstr("colours")));
  EXPECT_THROW(make_ramp("colours", {}), ConfigError);
  EXPECT_THROW(make_ramp("colours", std::vector<double>(51)), ConfigError);
  EXPECT_THROW(make_ramp("colours", colours, {0, 1}), ConfigError);
  EXPECT_THROW(make_ramp("colours", colours, {0, 0.5, 0.5, 1}), ConfigError);
  EXPECT_THROW(make_colour("joint", {1, 1}), ConfigError);
}

}  // namespace
}  // namespace gramloom
