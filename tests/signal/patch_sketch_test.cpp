#include "signal/patch_sketch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace gramloom {
namespace {

double squared_distance(const Image& image, PatchOrigin a, PatchOrigin b) {
  double sum = 0;
  for (int y = 0; y < field_patch; ++y)
    for (int x = 0; x < field_patch; ++x)
      for (int c = 0; c < field_features; ++c)
        sum += std::pow(image.at(a.x + x, a.y + y)[c] - image.at(b.x + x, b.y + y)[c], 2);
  return sum;
}

/// How many pairs of patches sketches tell apart that are further apart than a tenth of the mean;
/// none may be told apart that isn't.
double told_apart(const Image& image) {
  const SketchScale scale = sketch_scale(image);
  const auto sketches = sketch_patches(image, scale);
  const Size size = patch_origins(image.size());
  Random random(1);
  const auto draw = [&] {
    return PatchOrigin{static_cast<int>(random.below(static_cast<std::uint32_t>(size.width))),
                       static_cast<int>(random.below(static_cast<std::uint32_t>(size.height)))};
  };
  const auto sketch = [&](PatchOrigin o) -> const PatchSketch& {
    return sketches[static_cast<std::size_t>(o.y * size.width + o.x)];
  };
  const int pairs = 2000;
  double mean = 0;
  std::vector<std::pair<double, int>> found;
  for (int i = 0; i < pairs; ++i) {
    const PatchOrigin a = draw(), b = draw();
    const double distance = squared_distance(image, a, b);
    const int difference = differences(sketch(a), sketch(b), sketch(b), sketch(b), sketch(b))[0];
    EXPECT_LT(difference, telling_difference(static_cast<float>(distance) * 1.00001f, scale));
    mean += distance / pairs;
    found.emplace_back(distance, difference);
  }
  double told = 0;
  for (const auto& [distance, difference] : found)
    if (difference >= telling_difference(static_cast<float>(0.1 * mean), scale)) ++told;
  return told / pairs;
}

/// Squares of `side` pixels of random features.
Image squares(int side, float size) {
  Image image(61, 47, field_features);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      Random random(2, static_cast<std::uint64_t>(y / side * 100 + x / side));
      for (int c = 0; c < field_features; ++c) image.at(x, y)[c] = size * random.uniform(-1, 1);
    }
  return image;
}

TEST(PatchSketch, SaysNothingFalseAndMostOfSmoothPatches) {
  EXPECT_GT(told_apart(squares(9, 1)), 0.8);
  EXPECT_GT(told_apart(squares(5, 100)), 0.5);
  told_apart(squares(1, 1));
}

TEST(PatchSketch, SaysNothingFalseOfFlatPicturesAndOfSinglePixels) {
  Image image(40, 40, field_features, 3);
  EXPECT_EQ(told_apart(image), 0);
  image.at(20, 20)[1] = 1e4f;
  told_apart(image);
  image.at(11, 30)[2] = -1e4f;
  image.at(12, 30)[2] = 1e4f;
  told_apart(image);
}

TEST(PatchSketch, OfFourIsThatOfEach) {
  const Image image = squares(3, 1);
  const auto s = sketch_patches(image, sketch_scale(image));
  const Four four = differences(s[0], s[1], s[50], s[100], s[0]);
  EXPECT_EQ(four[3], 0);
  for (int i = 0; i < 3; ++i) {
    int sum = 0;
    const PatchSketch& other =
        s[std::array<std::size_t, 3>{1, 50, 100}[static_cast<std::size_t>(i)]];
    for (std::size_t k = 0; k < other.values.size(); ++k)
      sum += (s[0].values[k] - other.values[k]) * (s[0].values[k] - other.values[k]);
    EXPECT_EQ(four[i], sum);
  }
}

}  // namespace
}  // namespace gramloom
