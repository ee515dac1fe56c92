#include "surface/volume.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace gramloom {
namespace {

// 2 × 2 × 2 cells: x + 10 y + 100 z, y counted upwards.
Volume eight_cells() {
  Volume volume;
  for (int z = 0; z < 2; ++z) {
    Image slice(2, 2, 1);
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) *slice.at(x, 1 - y) = static_cast<float>(x + 10 * y + 100 * z);
    volume.slices.push_back(slice);
  }
  return volume;
}

TEST(Volume, TrilinearBetweenCentresByHand) {
  const Volume v = eight_cells();
  EXPECT_NEAR(trilinear(v, {0.25f, 0.25f, 0.25f}, Outside::clamp, {}).x, 0, 1e-5f);
  EXPECT_NEAR(trilinear(v, {0.75f, 0.75f, 0.75f}, Outside::clamp, {}).x, 111, 1e-4f);
  EXPECT_NEAR(trilinear(v, {0.5f, 0.5f, 0.5f}, Outside::clamp, {}).x, 55.5f, 1e-4f);
  // 0.3 of the way along x, 0.8 along y, 0.1 along z.
  EXPECT_NEAR(trilinear(v, {0.4f, 0.65f, 0.3f}, Outside::clamp, {}).x, 0.3f + 8 + 10, 1e-4f);
}

TEST(Volume, BeyondItsEdges) {
  const Volume v = eight_cells();
  // Half-way between the last and the first cell of x.
  EXPECT_NEAR(trilinear(v, {1, 0.25f, 0.25f}, Outside::tile, {}).x, 0.5f, 1e-4f);
  EXPECT_NEAR(trilinear(v, {-3, 0.25f, 0.25f}, Outside::tile, {}).x, 0.5f, 1e-4f);
  EXPECT_NEAR(trilinear(v, {1, 0.25f, 0.25f}, Outside::mirror, {}).x, 1, 1e-4f);
  EXPECT_NEAR(trilinear(v, {1.75f, 0.25f, 0.25f}, Outside::mirror, {}).x, 0, 1e-4f);
  EXPECT_NEAR(trilinear(v, {9, 0.25f, 0.25f}, Outside::clamp, {}).x, 1, 1e-4f);
  EXPECT_NEAR(trilinear(v, {1, 0.25f, 0.25f}, Outside::colour, {9, 9, 9}).x, 5, 1e-4f);
  EXPECT_NEAR(trilinear(v, {4, 0.25f, 0.25f}, Outside::colour, {9, 9, 9}).x, 9, 1e-4f);
}

TEST(Volume, SlicesAreAlikeAndTwoOrMore) {
  Volume v = eight_cells();
  EXPECT_NO_THROW(check_volume(v));
  v.slices.pop_back();
  EXPECT_THROW(check_volume(v), Error);
  v.slices.emplace_back(3, 2, 1);
  EXPECT_THROW(check_volume(v), Error);
}

}  // namespace
}  // namespace gramloom
