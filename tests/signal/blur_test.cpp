#include "signal/blur.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/random.h"

namespace gramloom {
namespace {

double sum(const Image& image) {
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0);
}

TEST(Blur, OfAPointIsAGaussian) {
  Image point({41, 41}, 1);
  point.at(20, 20)[0] = 1;
  const Image result = blurred(point, 2, Tile::none);
  EXPECT_NEAR(sum(result), 1, 1e-5);
  for (const int d : {0, 1, 3, 6})
    EXPECT_NEAR(result.at(20 + d, 20)[0] / result.at(20, 20)[0], std::exp(-d * d / 8.0), 1e-4);
}

TEST(Blur, GoesOnAcrossEdgesThatTile) {
  Image image({16, 12}, 2);
  Random random(3);
  for (float& value : image.pixels) value = random.uniform();
  const auto shifted = [](const Image& from, int dx, int dy) {
    Image result(from.size(), from.channels);
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x)
        for (int c = 0; c < from.channels; ++c)
          result.at((x + dx) % from.width, (y + dy) % from.height)[c] = from.at(x, y)[c];
    return result;
  };
  const Image moved = blurred(shifted(image, 5, 7), 3, Tile::both);
  const Image expected = shifted(blurred(image, 3, Tile::both), 5, 7);
  for (std::size_t i = 0; i < moved.pixels.size(); ++i)
    EXPECT_NEAR(moved.pixels[i], expected.pixels[i], 1e-6);
}

TEST(Blur, IsMirroredAtOtherEdgesAndKeepsAConstant) {
  const Image flat({5, 7}, 3, 0.25f);
  for (const Tile tile : {Tile::none, Tile::x, Tile::y, Tile::both})
    for (const float value : blurred(flat, 8, tile).pixels) EXPECT_NEAR(value, 0.25f, 1e-6);
  EXPECT_THROW(blurred({}, 1, Tile::none), Error);
}

}  // namespace
}  // namespace gramloom
