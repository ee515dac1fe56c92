// Height → normals → height.
#include "surface/height_from_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "surface/normal_map.h"

namespace gramloom {
namespace {

constexpr double full_pi = std::numbers::pi;

// The largest difference but for a constant, over the range of heights.
double relative_error(const Image& a, const Image& b) {
  const auto [low, high] = std::minmax_element(a.pixels.begin(), a.pixels.end());
  double least = 1e30, most = -1e30;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double difference = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
    least = std::min(least, difference);
    most = std::max(most, difference);
  }
  return (most - least) / 2 / static_cast<double>(*high - *low);
}

// Smooth waves that wrap on both axes; `tilt` and a bump make one that does not.
Image field(Size size, bool wraps_x, bool wraps_y) {
  Image height(size, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double u = 2 * full_pi * x / size.width, v = 2 * full_pi * y / size.height;
      double h = std::sin(u) * std::cos(2 * v) + 0.3 * std::sin(4 * u + 1) + 0.2 * std::cos(5 * v);
      if (!wraps_x) h += 0.4 * u + 0.1 * u * u;
      if (!wraps_y) h -= 0.3 * v + 0.05 * u * v * (wraps_x ? 0 : 1);
      *height.at(x, y) = static_cast<float>(h);
    }
  return height;
}

TEST(HeightFromNormals, ComesBackWithinOnePercentTilingAndNot) {
  for (const Size size : {Size{96, 80}, Size{75, 101}})
    for (const Tile tile : {Tile::none, Tile::x, Tile::y, Tile::both}) {
      const Image height = field(size, tiles_x(tile), tiles_y(tile));
      for (const double strength : {0.5, 6.0}) {
        const Image normals = normals_from_height(height, strength, tile);
        const Image back = height_from_normals(normals, strength, tile);
        EXPECT_LT(relative_error(height, back), 0.01)
            << size.width << " tile " << static_cast<int>(tile) << " strength " << strength;
      }
    }
}

TEST(HeightFromNormals, AlsoFromEightBits) {
  const Image height = field({96, 96}, true, true);
  Image picture = normals_to_colours(normals_from_height(height, 6, Tile::both), GreenAxis::down);
  for (float& value : picture.pixels) value = std::round(value * 255) / 255;
  const Image back =
      height_from_normals(colours_to_normals(picture, GreenAxis::down), 6, Tile::both);
  EXPECT_LT(relative_error(height, back), 0.03);
}

TEST(HeightFromNormals, ARampComesBackWhereNothingWraps) {
  Image ramp({33, 17}, 1);
  for (int y = 0; y < 17; ++y)
    for (int x = 0; x < 33; ++x) *ramp.at(x, y) = 0.1f * static_cast<float>(x + 2 * y);
  const Image back = height_from_normals(normals_from_height(ramp, 1, Tile::none), 1, Tile::none);
  EXPECT_LT(relative_error(ramp, back), 0.005);
  EXPECT_FLOAT_EQ(*std::min_element(back.pixels.begin(), back.pixels.end()), 0);
}

TEST(HeightFromNormals, OfOnePixelAndOfRowsIsLevelThere) {
  for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}}) {
    Image flat(size, 3);
    for (std::size_t i = 2; i < flat.pixels.size(); i += 3) flat.pixels[i] = 1;
    for (const Tile tile : {Tile::none, Tile::both})
      for (const float h : height_from_normals(flat, 1, tile).pixels) ASSERT_EQ(h, 0);
  }
}

TEST(HeightFromNormals, RefusesWhatAreNoNormals) {
  EXPECT_THROW(height_from_normals(Image({4, 4}, 2), 1, Tile::none), Error);
  EXPECT_THROW(height_from_normals(Image({4, 4}, 3), 0, Tile::none), Error);
}

}  // namespace
}  // namespace gramloom
