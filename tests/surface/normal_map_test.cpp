#include "surface/normal_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace gramloom {
namespace {

// h = x/4 + y/2 (rows downwards), a value of 1 being a pixel.
Image ramp(Size size) {
  Image height(size, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      *height.at(x, y) = 0.25f * static_cast<float>(x) + 0.5f * static_cast<float>(y);
  return height;
}

TEST(NormalMap, ARampHasItsExactNormalEverywhere) {
  const Image normals = normals_from_height(ramp({7, 5}), 1, Tile::none);
  const float length = std::sqrt(0.25f * 0.25f + 0.5f * 0.5f + 1);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) {
      EXPECT_FLOAT_EQ(normals.at(x, y)[0], -0.25f / length);
      EXPECT_FLOAT_EQ(normals.at(x, y)[1], 0.5f / length);  // y of a normal points up the picture
      EXPECT_FLOAT_EQ(normals.at(x, y)[2], 1 / length);
    }
}

TEST(NormalMap, StrengthIsHeightInPixels) {
  Image doubled = ramp({6, 6});
  for (float& h : doubled.pixels) h *= 2;
  EXPECT_EQ(normals_from_height(ramp({6, 6}), 2, Tile::none),
            normals_from_height(doubled, 1, Tile::none));
}

TEST(NormalMap, SlopesGoAcrossEdgesThatWrap) {
  Image height({4, 1}, 1);
  height.pixels = {0, 1, 0, 0};
  const Image wraps = normals_from_height(height, 1, Tile::x);
  EXPECT_LT(wraps.at(0, 0)[0], 0);        // rises to the right
  EXPECT_FLOAT_EQ(wraps.at(3, 0)[0], 0);  // both neighbours are 0
}

TEST(NormalMap, ColoursAndBackWithinAnEightBitStep) {
  const Image normals = normals_from_height(ramp({5, 5}), 1, Tile::none);
  for (const GreenAxis green : {GreenAxis::up, GreenAxis::down}) {
    Image picture = normals_to_colours(normals, green);
    for (float& value : picture.pixels) value = std::round(value * 255) / 255;
    const Image back = colours_to_normals(picture, green);
    for (std::size_t i = 0; i < back.pixels.size(); ++i)
      EXPECT_NEAR(back.pixels[i], normals.pixels[i], 1.0 / 127);
  }
}

TEST(NormalMap, AHeightHasOneChannel) {
  EXPECT_THROW(normals_from_height(Image({4, 4}, 3), 1, Tile::none), Error);
}

TEST(NormalMap, SignedComponentsAreReadAsSuch) {
  const Image normals = normals_from_height(ramp({4, 4}), 1, Tile::none);
  const Image back = colours_to_normals(normals, GreenAxis::up);
  for (std::size_t i = 0; i < back.pixels.size(); ++i)
    EXPECT_NEAR(back.pixels[i], normals.pixels[i], 1e-6);
}

}  // namespace
}  // namespace gramloom
