#include <gtest/gtest.h>

#include <algorithm>

#include "classic/pyramid.h"
#include "core/threads.h"
#include "directed_requests.h"

namespace gramloom {
namespace {

Image pyramid(const Request& request) {
  return synthesise(PyramidParams{.levels = 3, .iterations = 3}, request, {}).image;
}

std::vector<float> sorted_channel(const Image& image, int channel, int left, int right) {
  std::vector<float> values;
  for (int y = 0; y < image.height; ++y)
    for (int x = left; x < right; ++x) values.push_back(image.at(x, y)[channel]);
  std::ranges::sort(values);
  return values;
}

/// Mean distance of two quantile functions.
double distance(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  constexpr std::size_t ranks = 200;
  for (std::size_t i = 0; i < ranks; ++i)
    sum += std::abs(a[(2 * i + 1) * a.size() / (2 * ranks)] -
                    b[(2 * i + 1) * b.size() / (2 * ranks)]) /
           ranks;
  return sum;
}

Image scaled(Image image, float mean, float contrast) {
  for (float& v : image.pixels) v = mean + contrast * (v - 0.5f);
  return image;
}

TEST(DirectedPyramid, MaskedPixelsDoNotCount) {
  const Image whole = blobs(64, 48, 3, 1);
  Image picture = whole;
  const Image mask = rectangle({64, 48}, 20, 10, 25, 20, 0);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    if (mask.pixels[i / 3] < 0.5f) picture.pixels[i] = 9;
  const Image image = pyramid({{{picture, {}, mask}}, {{80, 80}, Tile::both}, Random(1)});
  for (int c = 0; c < 3; ++c) {
    const auto made = sorted_channel(image, c, 0, 80);
    EXPECT_LT(made.back(), 1.1f);
    EXPECT_LT(distance(made, sorted_channel(whole, c, 0, 64)), 0.02);
  }
}

TEST(DirectedPyramid, SeveralAreOneMaterialWithoutWeights) {
  const Image dark = scaled(blobs(40, 60, 1, 1), 0.2f, 1),
              light = scaled(blobs(60, 40, 1, 2), 0.8f, 2);
  const Image image = pyramid({{{dark}, {light}}, {{64, 64}, Tile::both}, Random(1)});
  auto all = sorted_channel(dark, 0, 0, 40), more = sorted_channel(light, 0, 0, 60);
  all.insert(all.end(), more.begin(), more.end());
  std::ranges::sort(all);
  EXPECT_LT(distance(sorted_channel(image, 0, 0, 64), all), 0.01);
}

TEST(DirectedPyramid, QuantilesAreMixedByWeights) {
  const Image dark = scaled(blobs(40, 60, 1, 1), 0.2f, 1),
              light = scaled(blobs(60, 40, 1, 2), 0.8f, 3);
  Request request{{{dark}, {light}}, {{128, 64}, Tile::both}, Random(1)};
  request.target.weights = Image(1, 1, 2, 0.5f);
  const auto of_dark = sorted_channel(dark, 0, 0, 40), of_light = sorted_channel(light, 0, 0, 60);
  std::vector<float> middle;
  for (std::size_t i = 0; i < of_dark.size(); ++i) middle.push_back((of_dark[i] + of_light[i]) / 2);
  EXPECT_LT(distance(sorted_channel(pyramid(request), 0, 0, 128), middle), 0.01);

  request.target.weights = Image({128, 64}, 2);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) request.target.weights.at(x, y)[x < 64 ? 0 : 1] = 1;
  const Image image = pyramid(request);
  EXPECT_LT(distance(sorted_channel(image, 0, 0, 64), of_dark), 0.02);
  EXPECT_LT(distance(sorted_channel(image, 0, 64, 128), of_light), 0.05);
  const int before = thread_count();
  set_thread_count(1);
  EXPECT_EQ(image, pyramid(request));
  set_thread_count(before);
}

}  // namespace
}  // namespace gramloom
