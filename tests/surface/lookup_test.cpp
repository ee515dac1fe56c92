// Lookups of pictures by the module.
#include <gtest/gtest.h>

#include "surface/environment.h"
#include "surface/texture_lookup.h"

namespace gramloom {
namespace {

// Four pixels in a row: 0, 1, 2, 3.
Image row() {
  Image image(4, 1, 1);
  for (int x = 0; x < 4; ++x) *image.at(x, 0) = static_cast<float>(x);
  return image;
}

float look(const TextureLookup& lookup, float u, float v = 0.5f, float width = 0) {
  const Footprint place{{u, v}, {width, 0}, {0, width}};
  float value = -1;
  lookup.at({&place, 1}, {&value, 1});
  return value;
}

TEST(TextureLookup, NearestBilinearAndTheirCentres) {
  const auto nearest = make_lookup(row(), Lookup::nearest, Outside::tile);
  const auto between = make_lookup(row(), Lookup::bilinear, Outside::tile);
  for (int x = 0; x < 4; ++x) {
    const float centre = (static_cast<float>(x) + 0.5f) / 4;
    EXPECT_FLOAT_EQ(look(*nearest, centre + 0.1f), static_cast<float>(x));
    EXPECT_NEAR(look(*between, centre), static_cast<float>(x), 1e-5f);
  }
  EXPECT_NEAR(look(*between, 0.5f), 1.5f, 1e-5f);
  EXPECT_NEAR(look(*between, 0.45f), 1.3f, 1e-5f);
}

TEST(TextureLookup, BicubicIsASplineOfFourPixels) {
  const auto cubic = make_lookup(row(), Lookup::bicubic, Outside::tile);
  // At a centre: 1/6, 4/6, 1/6; half-way between two: 1/48, 23/48, 23/48, 1/48.
  EXPECT_NEAR(look(*cubic, 0.625f), (1 + 4 * 2 + 3) / 6.0f, 1e-4f);
  EXPECT_NEAR(look(*cubic, 0.125f), (3 + 0 + 1) / 6.0f, 1e-4f);  // across the seam
  EXPECT_NEAR(look(*cubic, 0.5f), (0 + 23 + 46 + 3) / 48.0f, 1e-4f);
}

TEST(TextureLookup, TheSeamIsInterpolatedAcrossAndNegativesRoundDown) {
  const auto tile = make_lookup(row(), Lookup::bilinear, Outside::tile);
  // Half-way between the last pixel and the first; a tenth of the picture past it.
  for (const float turns : {-3.0f, -1.0f, 0.0f, 1.0f, 8.0f}) {
    EXPECT_NEAR(look(*tile, turns), 1.5f, 1e-4f);
    EXPECT_NEAR(look(*tile, turns + 0.1f), 3 * 0.1f, 1e-4f);
    EXPECT_NEAR(look(*tile, turns - 0.1f), 3 * 0.9f, 1e-4f);
  }
}

TEST(TextureLookup, MirrorClampAndNothingOutside) {
  const auto mirror = make_lookup(row(), Lookup::bilinear, Outside::mirror);
  const auto clamp = make_lookup(row(), Lookup::bilinear, Outside::clamp);
  const auto none = make_lookup(row(), Lookup::bilinear, Outside::colour);
  EXPECT_NEAR(look(*mirror, 1.125f), 3, 1e-5f);
  EXPECT_NEAR(look(*mirror, 1.375f), 2, 1e-5f);
  EXPECT_NEAR(look(*mirror, -0.375f), 1, 1e-5f);
  EXPECT_NEAR(look(*clamp, 7.3f), 3, 1e-5f);
  EXPECT_NEAR(look(*clamp, -0.2f), 0, 1e-5f);
  EXPECT_NEAR(look(*none, 1.3f), 0, 1e-5f);
  EXPECT_NEAR(look(*none, 0.875f), 3, 1e-5f);
}

TEST(TextureLookup, VIsUpThePicture) {
  Image column(1, 2, 1);
  *column.at(0, 0) = 1;  // above
  const auto lookup = make_lookup(column, Lookup::nearest, Outside::clamp);
  EXPECT_EQ(look(*lookup, 0.5f, 0.75f), 1);
  EXPECT_EQ(look(*lookup, 0.5f, 0.25f), 0);
}

TEST(TextureLookup, AReducedCheckerboardIsGrey) {
  for (const int side : {64, 100}) {
    Image board(side, side, 1);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) *board.at(x, y) = static_cast<float>((x + y) & 1);
    const auto lookup = make_lookup(board, Lookup::filtered, Outside::tile);
    for (const float width : {0.1f, 0.25f, 1.0f, 5.0f})
      for (const float u : {0.0f, 0.137f, 0.51f, 0.93f})
        EXPECT_NEAR(look(*lookup, u, 0.3f, width), 0.5f, 0.02f) << side << " " << width;
  }
}

TEST(TextureLookup, FilteredIsBilinearWhereThePictureIsEnlarged) {
  const auto filtered = make_lookup(row(), Lookup::filtered, Outside::tile);
  EXPECT_NEAR(look(*filtered, 0.45f, 0.5f, 1e-4f), 1.3f, 1e-3f);
  EXPECT_NEAR(look(*filtered, 0, 0.5f, 1e-4f), 1.5f, 1e-3f);
}

TEST(TextureLookup, ManyChannels) {
  Image image(2, 2, 9);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i % 9);
  const auto lookup = make_lookup(image, Lookup::filtered, Outside::tile);
  const Footprint places[]{{{0.3f, 0.4f}, {0.1f, 0}, {0, 0.1f}}, {{0.9f, 0.1f}, {}, {}}};
  std::vector<float> values(18, -1);
  lookup->at(places, values);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], static_cast<float>(i % 9), 1e-5f);
}

TEST(TextureLookup, EnvironmentsAreSeenWhereTheyLie) {
  Image sky(128, 64, 3);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      const Vec3 d = direction_of_latlong(
          {(static_cast<float>(x) + 0.5f) / 128, 1 - (static_cast<float>(y) + 0.5f) / 64});
      float* p = sky.at(x, y);
      p[0] = d.x;
      p[1] = d.y;
      p[2] = d.z;
    }
  const auto lookup = make_lookup(sky, Lookup::filtered, Outside::tile);
  for (const Vec3 d : {Vec3{0, 0, -1}, Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0.2f, 0.9f, 0.1f},
                       Vec3{-0.5f, -0.6f, 0.3f}, Vec3{0, 1, 0}}) {
    const Cone cone{normalised(d), 0.01f};
    Vec3 seen;
    lookup->along({&cone, 1}, {&seen, 1});
    EXPECT_GT(dot(normalised(seen), cone.direction), 0.998f) << d.x << " " << d.y << " " << d.z;
  }
}

}  // namespace
}  // namespace gramloom
