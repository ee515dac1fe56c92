#include "surface/arm.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gramloom {
namespace {

TEST(Arm, PlacesComeBackFromTheirPoints) {
  for (const double bend : {0.0, 20.0, 70.0, 120.0}) {
    const ArmAxis axis(bend);
    for (double along = -4.5; along <= 4.5; along += 0.37)
      for (double around = 0.01; around < 1; around += 0.09)
        for (const double from : {0.5, 1.0, 1.3}) {
          const ArmPlace place = place_of(axis, point_at(axis, {along, around, from}));
          ASSERT_NEAR(place.along, along, 1e-9) << bend;
          ASSERT_NEAR(place.around, around, 1e-9) << bend;
          ASSERT_NEAR(place.from, from, 1e-9) << bend;
        }
  }
}

TEST(Arm, BendsByItsAngleAndKeepsItsLength) {
  const ArmAxis axis(70);
  const ArmAxis::Frame upper = axis.frame(-4), lower = axis.frame(4);
  const double cosine = upper.along_y * lower.along_y + upper.along_z * lower.along_z;
  EXPECT_NEAR(std::acos(cosine), 70 * 3.14159265358979 / 180, 1e-12);
  double length = 0;
  constexpr int pieces = 4000;
  for (int i = 0; i < pieces; ++i) {
    const auto a = axis.frame(-4 + 8.0 * i / pieces), b = axis.frame(-4 + 8.0 * (i + 1) / pieces);
    length += std::hypot(b.y - a.y, b.z - a.z);
  }
  EXPECT_NEAR(length, arm_length, 1e-5);
}

TEST(Arm, TheMiddleColumnIsTheInsideOfTheElbow) {
  const ArmAxis axis(90);
  EXPECT_GT(point_at(axis, {0, 0.5, 1}).z, 0.9);
  EXPECT_LT(point_at(axis, {0, 0, 1}).z, -0.9);
  EXPECT_GT(point_at(axis, {-4, 0.5, 1}).y, 1) << "the upper end is above";
}

}  // namespace
}  // namespace gramloom
