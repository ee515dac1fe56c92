// A photograph becomes a material.
#include "surface/photo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/random.h"

namespace gramloom {
namespace {

// Grain about a colour: a material without features as large as the light's.
Image grain(Size size, int channels) {
  Image image(size, channels);
  Random random(3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = (0.3f + 0.1f * static_cast<float>(i % static_cast<std::size_t>(channels))) *
                      random.uniform(0.8f, 1.2f);
  return image;
}

Image lit(Image image, const auto& light) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < std::min(image.channels, 3); ++c)
        image.at(x, y)[c] *=
            static_cast<float>(light(1.0 * x / image.width, 1.0 * y / image.height, c));
  return image;
}

// The largest deviation of a / b from its mean, over the mean.
double unevenness(const Image& a, const Image& b, int channel) {
  double sum = 0, least = 1e30, most = 0;
  std::size_t count = 0;
  for (std::size_t i = static_cast<std::size_t>(channel); i < a.pixels.size();
       i += static_cast<std::size_t>(a.channels), ++count) {
    const double ratio = static_cast<double>(a.pixels[i]) / static_cast<double>(b.pixels[i]);
    sum += ratio;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  const double mean = sum / static_cast<double>(count);
  return std::max(most - mean, mean - least) / mean;
}

TEST(Photo, LightThatFallsOffIsDividedAway) {
  const Image material = grain({160, 120}, 3);
  const Image photo = lit(material, [](double u, double v, int) {
    return std::exp(-0.9 * u + 0.5 * v - 0.6 * (u - 0.5) * (u - 0.5));
  });
  ASSERT_GT(unevenness(photo, material, 0), 0.4);
  const Image flat = without_shading(photo, 0.25, 1, ColourCast::even);
  for (int c = 0; c < 3; ++c) EXPECT_LT(unevenness(flat, material, c), 0.05) << c;
  EXPECT_EQ(without_shading(photo, 0.25, 0, ColourCast::even), photo);
}

TEST(Photo, ACastThatVariesIsMadeEvenOrKept) {
  const Image material = grain({160, 120}, 3);
  const Image photo = lit(material, [](double u, double, int c) {
    return std::exp((c == 0 ? 0.5 : c == 2 ? -0.5 : 0.0) * u);  // ever warmer to the right
  });
  for (const int c : {0, 2}) {
    EXPECT_LT(unevenness(without_shading(photo, 0.25, 1, ColourCast::even), material, c), 0.05);
    EXPECT_GT(unevenness(without_shading(photo, 0.25, 1, ColourCast::keep), material, c), 0.15);
  }
}

TEST(Photo, ACastAllOverIsTakenOutOfGreyAlone) {
  const Image grey = grain({96, 96}, 1);
  Image photo({96, 96}, 3);
  for (std::size_t i = 0; i < grey.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      photo.pixels[3 * i + c] = grey.pixels[i] * (c == 0 ? 1.2f : c == 2 ? 0.7f : 1.0f);
  const Image flat = without_shading(photo, 0.25, 1, ColourCast::grey);
  for (std::size_t i = 0; i < flat.pixels.size(); i += 3) {
    ASSERT_NEAR(flat.pixels[i], flat.pixels[i + 1], 0.01);
    ASSERT_NEAR(flat.pixels[i + 2], flat.pixels[i + 1], 0.01);
  }
  const Image even = without_shading(photo, 0.25, 1, ColourCast::even);
  EXPECT_GT(even.pixels[0], even.pixels[2] * 1.5f);
}

TEST(Photo, AlphaStaysAndSmallPicturesWork) {
  Image photo = grain({40, 30}, 4);
  const Image flat = without_shading(photo, 0.25, 1, ColourCast::even);
  for (std::size_t i = 3; i < photo.pixels.size(); i += 4)
    ASSERT_EQ(flat.pixels[i], photo.pixels[i]);
  for (const Size size : {Size{1, 1}, Size{1, 9}, Size{5, 1}, Size{3, 3}})
    for (const auto& [name, map] : material_from_photo(Image(size, 3, 0.5f), {}))
      for (const float value : map.pixels) ASSERT_TRUE(std::isfinite(value)) << name;
  EXPECT_THROW(material_from_photo(Image({4, 4}, 2), {}), Error);
}

// A checkerboard seen at a slant, by the homography's own formula, comes back square.
TEST(Photo, ARectangleSeenAtASlantIsSetRight) {
  const auto checker = [](double u, double v) {
    return (static_cast<int>(std::floor(u * 8)) + static_cast<int>(std::floor(v * 8))) % 2 ? 0.9f
                                                                                           : 0.1f;
  };
  // The photo's (x, y) of the rectangle's (u, v): x = (20 + 90 u) / (1 + 0.2 u), and so on.
  const auto corner = [](double u, double v) {
    const double w = 1 + 0.2 * u + 0.3 * v;
    return std::pair{(20 + 110 * u + 10 * v) / w, (15 + 8 * u + 120 * v) / w};
  };
  Image photo({128, 128}, 1);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      double u = 0.5, v = 0.5;
      for (int i = 0; i < 60; ++i) {  // by fixed points: the inverse of corner()
        const double w = 1 + 0.2 * u + 0.3 * v;
        u = (x * w - 20 - 10 * v) / 110;
        v = (y * w - 15 - 8 * u) / 120;
      }
      *photo.at(x, y) = checker(u, v);
    }
  std::vector<double> corners;
  for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
    corners.push_back(corner(u, v).first);
    corners.push_back(corner(u, v).second);
  }
  const Image flat = set_right(photo, corners, {81, 81});
  ASSERT_EQ(flat.size(), (Size{81, 81}));
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column)
      EXPECT_NEAR(*flat.at(10 * column + 5, 10 * row + 5), (row + column) % 2 ? 0.9 : 0.1, 0.1)
          << column << ", " << row;
  EXPECT_EQ(set_right(photo, corners, {}).width, 81) << "the mean of 88 and 71, and a pixel";
}

TEST(Photo, CornersAndSizesThatAreNoneAreRefused) {
  const Image photo = grain({20, 20}, 3);
  EXPECT_THROW(set_right(photo, {1, 2, 3}, {}), ConfigError);
  EXPECT_THROW(set_right(photo, {0, 0, 0, 9, 9, 9, 9, 0}, {}), ConfigError)
      << "the other way round";
  EXPECT_THROW(set_right(photo, {0, 0, 9, 0, 2, 2, 0, 9}, {}), ConfigError) << "not convex";
  EXPECT_THROW(set_right(photo, {0, 0, 9, 0, 9, 9, 0, 9}, {4}), ConfigError);
  EXPECT_THROW(set_right(photo, {0, 0, 21, 0, 9, 9, 0, 9}, {}), ConfigError) << "outside";
  EXPECT_THROW(set_right(photo, {0, -1, 9, 0, 9, 9, 0, 9}, {}), ConfigError) << "outside";
  EXPECT_NO_THROW(set_right(photo, {0, 0, 20, 0, 20, 20, 0, 20}, {}));
  PhotoParams params;
  params.light_scale = 0;
  EXPECT_THROW(material_from_photo(photo, params), ConfigError);
}

TEST(Photo, HeightIsBrightnessAtEachScaleAndRoughnessIsDeep) {
  Image photo({128, 128}, 1);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      *photo.at(x, y) = 0.5f + 0.2f * std::sin(0.4f * static_cast<float>(x)) *
                                   std::sin(0.4f * static_cast<float>(y));
  const Image height = height_guess(photo, 0.35, 0.75, false);
  const auto [low, high] = std::minmax_element(height.pixels.begin(), height.pixels.end());
  EXPECT_EQ(*low, 0);
  EXPECT_EQ(*high, 1);
  const Image deep = height_guess(photo, 0.35, 0.75, true);
  const Image rough = roughness_guess(height, 0.8, 0.3);
  for (std::size_t i = 0; i < height.pixels.size(); i += 77) {
    EXPECT_NEAR(deep.pixels[i], 1 - height.pixels[i], 0.02);
    if (photo.pixels[i] > 0.6f) {
      EXPECT_GT(height.pixels[i], 0.6f);
    }
    if (photo.pixels[i] < 0.4f) {
      EXPECT_LT(height.pixels[i], 0.4f);
      EXPECT_GT(rough.pixels[i], 0.8f);
    }
  }
  EXPECT_EQ(height_guess(Image({9, 9}, 3, 0.3f), 0.35, 0.75, false), Image({9, 9}, 1, 0.5f));
}

// The same picture from another place on: its height is the same one from there on.
TEST(Photo, HeightOfAPictureThatTilesTiles) {
  Image photo({96, 64}, 3);
  Random random(3);
  for (float& value : photo.pixels) value = random.uniform();
  for (int y = 0; y < 64; ++y)  // something large besides
    for (int x = 0; x < 96; ++x)
      for (int c = 0; c < 3; ++c)
        photo.at(x, y)[c] += 0.5f * std::sin(0.0654498f * static_cast<float>(x)) +
                             0.5f * std::cos(0.0981748f * static_cast<float>(y));
  const auto rolled = [](const Image& image) {
    Image result(image.size(), image.channels);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        std::copy_n(image.at((x + 40) % image.width, (y + 24) % image.height), image.channels,
                    result.at(x, y));
    return result;
  };
  const auto difference = [&](Tile wraps) {
    const Image expected = rolled(height_guess(photo, 0.35, 0.75, false, wraps));
    const Image found = height_guess(rolled(photo), 0.35, 0.75, false, wraps);
    double most = 0;
    for (std::size_t i = 0; i < found.pixels.size(); ++i)
      most = std::max(most, std::abs(double{found.pixels[i]} - double{expected.pixels[i]}));
    return most;
  };
  EXPECT_LT(difference(Tile::both), 0.01);
  EXPECT_GT(difference(Tile::none), 0.05) << "the test sees seams";
}

}  // namespace
}  // namespace gramloom
