#include "signal/layer_axes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace gramloom {
namespace {

const std::vector<Layer> layers{{"", MapKind::colour, 0, 3},
                                {"height", MapKind::scalar, 3, 1},
                                {"flow", MapKind::scalar, 4, 2}};

// Colours that are correlated; a height that follows them with something of its own; a flow whose
// first channel is a linear function of the colours.
Image sample() {
  Image image({90, 70}, 6);
  Random random(4);
  for (std::size_t i = 0; i < image.pixels.size(); i += 6) {
    const float a = random.normal(), b = random.normal(), c = random.normal();
    float* p = image.pixels.data() + i;
    p[0] = 0.5f + 0.1f * a;
    p[1] = 0.4f + 0.08f * a + 0.05f * b;
    p[2] = 0.3f + 0.02f * c - 0.05f * a;
    p[3] = 40 * (0.3f * p[0] + 0.1f * random.normal());
    p[4] = p[0] - 2 * p[2];
    p[5] = 0.2f * random.normal() + p[3] / 40;
  }
  return image;
}

double product(const Image& image, int a, int b) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels))
    sum += static_cast<double>(image.pixels[i + static_cast<std::size_t>(a)]) *
           static_cast<double>(image.pixels[i + static_cast<std::size_t>(b)]);
  return sum / (image.width * image.height);
}

TEST(LayerAxes, BlocksAreWhatMayBeMixed) {
  using Blocks = std::vector<ChannelBlock>;
  EXPECT_EQ(channel_blocks({}, 5), (Blocks{{0, 5}}));
  EXPECT_EQ(channel_blocks(layers, 6), (Blocks{{0, 3}, {3, 1}, {4, 1}, {5, 1}}));
  EXPECT_EQ(
      channel_blocks(
          {{"", MapKind::colour, 0, 3}, {"", MapKind::alpha, 3, 1}, {"n", MapKind::normal, 4, 3}},
          7),
      (Blocks{{0, 3}, {3, 1}, {4, 3}}));
}

TEST(LayerAxes, AreNotCorrelatedAndComeBack) {
  const Image image = sample();
  const LayerAxes axes = layer_axes(image, layers);
  const Image white = whitened(image, axes);
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b <= a; ++b)
      EXPECT_NEAR(product(white, a, b), a == b && a != 4 ? 1 : 0, 1e-3) << a << " " << b;
  EXPECT_TRUE(axes.is_flat(4)) << "a function of the colours";
  EXPECT_FALSE(axes.is_flat(5));
  const Image back = unwhitened(white, axes);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    ASSERT_NEAR(back.pixels[i], image.pixels[i], 1e-4 * (i % 6 == 3 ? 40 : 1)) << i;
}

TEST(LayerAxes, ColoursAreAsIfThereWereNoMaps) {
  const Image image = sample();
  const Image colours = extract_channels(image, 0, 3);
  EXPECT_EQ(extract_channels(whitened(image, layer_axes(image, layers)), 0, 3),
            whitened(colours, colour_pca(colours)));
}

TEST(LayerAxes, WithoutLayersAreThePrincipalAxes) {
  const Image image = sample();
  const ColourPca pca = colour_pca(image);
  const LayerAxes axes = layer_axes(image, {});
  EXPECT_EQ(axes.own, pca);
  const Image white = whitened(image, pca);
  EXPECT_EQ(whitened(image, axes), white);
  EXPECT_EQ(unwhitened(white, axes), unwhitened(white, pca));
}

}  // namespace
}  // namespace gramloom
