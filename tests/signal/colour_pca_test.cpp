#include "signal/colour_pca.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "core/threads.h"

namespace gramloom {
namespace {

Image correlated(int channels, std::uint64_t seed) {
  Image image(150, 110, channels);
  Random random(seed);
  std::vector<float> mix(static_cast<std::size_t>(channels * channels));
  for (float& m : mix) m = random.normal();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int k = 0; k < channels; ++k) {
        const float v = random.normal();
        for (int c = 0; c < channels; ++c)
          image.at(x, y)[c] += 0.1f * mix[static_cast<std::size_t>(c * channels + k)] * v + 0.2f;
      }
  return image;
}

double covariance(const Image& image, int a, int b) {
  double sa = 0, sb = 0, sab = 0;
  const double n = static_cast<double>(image.width) * image.height;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const float* p = image.at(x, y);
      sa += static_cast<double>(p[a]);
      sb += static_cast<double>(p[b]);
      sab += static_cast<double>(p[a]) * static_cast<double>(p[b]);
    }
  return sab / n - sa / n * (sb / n);
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(a.pixels[i] - b.pixels[i])));
  return largest;
}

class ColourPcaOf : public testing::TestWithParam<int> {};

TEST_P(ColourPcaOf, WhitensAndComesBack) {
  const Image image = correlated(GetParam(), 1);
  const ColourPca pca = colour_pca(image);
  const Image white = whitened(image, pca);
  for (int a = 0; a < image.channels; ++a)
    for (int b = a; b < image.channels; ++b)
      EXPECT_NEAR(covariance(white, a, b), a == b ? 1 : 0, 2e-4) << a << " " << b;
  EXPECT_LT(largest_difference(unwhitened(white, pca), image), 2e-5);
  for (std::size_t i = 1; i < pca.deviation.size(); ++i)
    EXPECT_GE(pca.deviation[i - 1], pca.deviation[i]);
}

INSTANTIATE_TEST_SUITE_P(Channels, ColourPcaOf, testing::Values(1, 2, 3, 8, 24));

TEST(ColourPca, FindsKnownAxes) {
  // Along (3, 4)/5 the colours are ±2, along (4, −3)/5 they are ±1.
  Image image(2, 2, 2);
  const float along[] = {2, 2, -2, -2}, across[] = {1, -1, 1, -1};
  for (int i = 0; i < 4; ++i) {
    image.at(i % 2, i / 2)[0] = (3 * along[i] + 4 * across[i]) / 5 + 10;
    image.at(i % 2, i / 2)[1] = (4 * along[i] - 3 * across[i]) / 5 + 20;
  }
  const ColourPca pca = colour_pca(image);
  EXPECT_NEAR(pca.mean[0], 10, 1e-6);
  EXPECT_NEAR(pca.mean[1], 20, 1e-6);
  EXPECT_NEAR(pca.deviation[0], 2, 1e-6);
  EXPECT_NEAR(pca.deviation[1], 1, 1e-6);
  const float expected[] = {0.6f, 0.8f, 0.8f, -0.6f};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(pca.axes[i], expected[i], 1e-6);
}

TEST(ColourPca, FlatAxesCarryNothing) {
  // Grey stored as RGB: one axis, and no noise from the other two.
  const Image grey = correlated(1, 2);
  Image image(grey.size(), 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = *grey.at(x, y);
  const ColourPca pca = colour_pca(image);
  EXPECT_GT(pca.deviation[0], 0);
  EXPECT_EQ(pca.deviation[1], 0);
  EXPECT_EQ(pca.deviation[2], 0);
  Image white = whitened(image, pca);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      ASSERT_EQ(white.at(x, y)[1], 0);
      ASSERT_EQ(white.at(x, y)[2], 0);
      white.at(x, y)[2] = 5;  // to be dropped
    }
  EXPECT_LT(largest_difference(unwhitened(white, pca), image), 1e-6);
}

TEST(ColourPca, ConstantImagesComeBackExactly) {
  Image image(5, 4, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = 0.1f + 0.3f * static_cast<float>(i % 3);
  const ColourPca pca = colour_pca(image);
  EXPECT_EQ(pca.deviation, std::vector<float>(3));
  EXPECT_EQ(unwhitened(whitened(image, pca), pca), image);
}

TEST(ColourPca, SameForAnyThreads) {
  const Image image = correlated(7, 3);
  set_thread_count(1);
  const auto one = colour_pca(image);
  set_thread_count(8);
  EXPECT_EQ(colour_pca(image), one);
  EXPECT_EQ(whitened(image, one).pixels.size(), image.pixels.size());
  set_thread_count(0);
}

TEST(ColourPca, RefusesWhatDoesNotFit) {
  EXPECT_THROW(colour_pca(Image()), Error);
  EXPECT_THROW(whitened(Image(2, 2, 3), colour_pca(Image(2, 2, 2))), Error);
  EXPECT_THROW(unwhitened(Image(2, 2, 3), colour_pca(Image(2, 2, 2))), Error);
}

}  // namespace
}  // namespace gramloom
