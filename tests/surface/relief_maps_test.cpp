// Occlusion and curvature against closed forms.
#include "surface/relief_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.h"
#include "core/threads.h"

namespace gramloom {
namespace {

Image height_of(Size size, const std::function<double(double x, double y)>& h) {
  Image height(size, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) *height.at(x, y) = static_cast<float>(h(x, y));
  return height;
}

TEST(Occlusion, PlanesSeeAllOfTheirSkyHoweverSteep) {
  for (const double slope : {0.0, 0.3, 1.0, 4.0}) {
    const Image plane =
        height_of({40, 30}, [&](double x, double y) { return slope * (x + 0.5 * y); });
    for (const float seen : ambient_occlusion(plane, 1, 16, 16, Tile::none).pixels)
      ASSERT_NEAR(seen, 1, 1e-3) << slope;
  }
}

// In the middle of a round pit of radius R and depth H each horizon stands at the angle of tangent
// H/R: cos² of it is left. Steps grow by an eighth, so the wall may be seen up to that further
// away.
TEST(Occlusion, TheMiddleOfARoundPit) {
  constexpr double radius = 20;
  for (const double depth : {5.0, 20.0, 60.0}) {
    const Image pit = height_of({81, 81}, [&](double x, double y) {
      return std::hypot(x - 40, y - 40) < radius ? 0 : depth;
    });
    const auto seen_with_wall_at = [&](double r) { return 1 / (1 + depth * depth / (r * r)); };
    const float seen = *ambient_occlusion(pit, 1, 36, 32, Tile::none).at(40, 40);
    EXPECT_GE(seen, seen_with_wall_at(radius) - 0.005) << depth;
    EXPECT_LE(seen, seen_with_wall_at(1.125 * radius) + 0.005) << depth;
  }
}

// At distance d from an endless wall of height H, half of the lines' ends look at it: along angle φ
// off the perpendicular the tangent is H cos φ / d. Mean of cos² over all: (1 + 1/√(1 + H²/d²))/2.
TEST(Occlusion, LevelGroundBesideAWall) {
  const Image wall = height_of({200, 240}, [](double x, double) { return x < 100 ? 12.0 : 0.0; });
  const Image seen = ambient_occlusion(wall, 1, 90, 32, Tile::none);
  for (const int distance : {4, 8, 12}) {
    const double t = 12.0 / distance;
    EXPECT_NEAR(*seen.at(99 + distance, 120), 0.5 + 0.5 / std::sqrt(1 + t * t), 0.04) << distance;
  }
  EXPECT_NEAR(*seen.at(50, 120), 1, 1e-3) << "above it";
}

TEST(Occlusion, StrengthIsHeightInPixelsAndGroundGoesOnWhereItWraps) {
  const auto ridge = [](double scale) {
    return height_of({32, 32}, [=](double x, double) { return x < 2 ? 8 * scale : 0.0; });
  };
  EXPECT_EQ(ambient_occlusion(ridge(1), 1, 8, 8, Tile::x),
            ambient_occlusion(ridge(0.125), 8, 8, 8, Tile::x));
  EXPECT_LT(*ambient_occlusion(ridge(1), 1, 8, 8, Tile::x).at(31, 16), 0.8f);
  EXPECT_NEAR(*ambient_occlusion(ridge(1), 1, 8, 8, Tile::y).at(31, 16), 1, 1e-3);
}

TEST(Occlusion, TheSameBytesForAnyThreadsAndRefusals) {
  const Image bumps =
      height_of({50, 70}, [](double x, double y) { return 4 * std::sin(x / 3) * std::cos(y / 4); });
  set_thread_count(1);
  const Image one = ambient_occlusion(bumps, 1, 20, 8, Tile::both);
  set_thread_count(8);
  EXPECT_EQ(ambient_occlusion(bumps, 1, 20, 8, Tile::both), one);
  set_thread_count(0);
  EXPECT_THROW(ambient_occlusion(Image({4, 4}, 3), 1, 4, 4, Tile::none), Error);
  EXPECT_THROW(ambient_occlusion(bumps, 1, 0, 4, Tile::none), Error);
  EXPECT_THROW(ambient_occlusion(bumps, 1, 4, 0, Tile::none), Error);
}

TEST(Curvature, OfABallACylinderAndTheirHollows) {
  constexpr double radius = 50;
  for (const double side : {1.0, -1.0}) {
    const Image ball = height_of({31, 31}, [&](double x, double y) {
      return side * std::sqrt(radius * radius - (x - 15) * (x - 15) - (y - 15) * (y - 15));
    });
    const Image cylinder = height_of({31, 31}, [&](double x, double) {
      return side * std::sqrt(radius * radius - (x - 15) * (x - 15));
    });
    // A ball has the same curvature all over it, not at its top alone.
    for (const int x : {5, 15, 25}) {
      EXPECT_NEAR(*curvature(ball, 1, radius / 2, 0, Tile::none).at(x, 15), 0.5 + side * 0.25,
                  1e-3);
      EXPECT_NEAR(*curvature(cylinder, 1, radius, 0, Tile::none).at(x, 15), 0.5 + side * 0.25,
                  1e-3);
    }
  }
}

TEST(Curvature, ARampIsFlatUpToItsEdges) {
  const Image ramp = height_of({9, 7}, [](double x, double y) { return 0.5 * x - 2 * y; });
  for (const double scale : {2.0, 5.0})
    for (const float value : curvature(ramp, 3, 10, scale, Tile::none).pixels)
      ASSERT_NEAR(value, 0.5, 1e-3) << scale;
  for (const float value : curvature(ramp, 3, 10, 0, Tile::none).pixels)
    ASSERT_NEAR(value, 0.5, 1e-5);
}

TEST(Curvature, LooksAcrossEdgesThatWrap) {
  const Image wave =
      height_of({16, 16}, [](double x, double) { return std::cos(2 * std::numbers::pi * x / 16); });
  const Image map = curvature(wave, 1, 2, 0, Tile::both);
  EXPECT_GT(*map.at(0, 3), 0.55f);
  EXPECT_FLOAT_EQ(*map.at(1, 3), *map.at(15, 3));
  // A Gaussian of deviation s takes exp(−(s k)² / 2) off a wave of frequency k.
  const double k = 2 * std::numbers::pi / 16;
  EXPECT_NEAR((*curvature(wave, 0.01, 2, 3, Tile::both).at(0, 3) - 0.5) /
                  (*curvature(wave, 0.01, 2, 0, Tile::both).at(0, 3) - 0.5),
              std::exp(-9 * k * k / 2), 1e-3);
  EXPECT_THROW(curvature(wave, 1, 1, -1, Tile::both), Error);
  EXPECT_THROW(curvature(Image({4, 4}, 2), 1, 1, 0, Tile::none), Error);
  EXPECT_THROW(curvature(wave, 1, 0, 0, Tile::none), Error);
}

}  // namespace
}  // namespace gramloom
