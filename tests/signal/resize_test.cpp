#include "signal/resize.h"

#include <gmock/gmock.h>

#include "core/random.h"
#include "io/temp_folder.h"

namespace gramloom {
namespace {

using testing::HasSubstr;

Image noise(int width, int height, int channels) {
  Image image(width, height, channels);
  Random random(1, 2);
  for (float& value : image.pixels) value = random.uniform();
  return image;
}

double mean(const Image& image, int channel) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += static_cast<double>(image.at(x, y)[channel]);
  return sum / (static_cast<double>(image.width) * image.height);
}

TEST(Resize, ConstantStaysConstant) {
  for (const int channels : {1, 2, 3, 4, 5, 64})
    for (const Size size : {Size{7, 5}, Size{64, 48}, Size{7, 48}, Size{64, 5}, Size{1, 1}}) {
      const Image result = resize(Image(20, 16, channels, 0.3f), size);
      EXPECT_EQ(result.size(), size);
      EXPECT_EQ(result.channels, channels);
      for (const float value : result.pixels) EXPECT_NEAR(value, 0.3f, 1e-6f);
    }
}

TEST(Resize, SameSizeIsTheSameImage) {
  const Image image = noise(13, 9, 3);
  EXPECT_EQ(resize(image, {13, 9}), image);
}

TEST(Resize, ShrinkingKeepsTheMean) {
  for (const int channels : {1, 3, 5, 64}) {
    const Image image = noise(60, 40, channels);
    for (const Size size : {Size{30, 20}, Size{17, 23}, Size{1, 1}, Size{59, 39}}) {
      const Image result = resize(image, size);
      for (int c = 0; c < channels; ++c) EXPECT_NEAR(mean(result, c), mean(image, c), 1e-5) << c;
    }
  }
}

TEST(Resize, HalvingAveragesFourPixels) {
  const Image image = noise(8, 6, 5);
  const Image half = resize(image, {4, 3});
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 5; ++c) {
        const float sum = image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                          image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c];
        EXPECT_NEAR(half.at(x, y)[c], sum / 4, 1e-6f);
      }
}

TEST(Resize, RangeIsKeptInEachChannel) {
  Image image = noise(16, 16, 6);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      image.at(x, y)[1] = x < 8 ? -5.0f : 1000.0f;  // a cubic overshoots at this edge
      image.at(x, y)[5] = 2.0f;
    }
  const ChannelRange before = channel_range(image);
  for (const Size size : {Size{50, 41}, Size{16, 33}, Size{5, 40}}) {
    const ChannelRange after = channel_range(resize(image, size));
    for (std::size_t c = 0; c < 6; ++c) {
      EXPECT_GE(after.low[c], before.low[c]);
      EXPECT_LE(after.high[c], before.high[c]);
    }
  }
}

TEST(Resize, EachChannelByItself) {
  const Image image = noise(20, 14, 7);
  for (const Size size : {Size{9, 6}, Size{31, 40}, Size{9, 40}}) {
    const Image all = resize(image, size);
    for (int c = 0; c < 7; ++c) {
      const Image one = resize(extract_channels(image, c, 1), size);
      for (std::size_t i = 0; i < one.pixels.size(); ++i)
        EXPECT_NEAR(extract_channels(all, c, 1).pixels[i], one.pixels[i], 1e-6f);
    }
  }
}

TEST(Resize, EnlargingKeepsALinearRamp) {
  Image ramp(32, 4, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 32; ++x) *ramp.at(x, y) = static_cast<float>(x);
  const Image result = resize(ramp, {64, 4});
  // A pixel's centre, x + 0.5, lies at 2 (x + 0.5) in the result. With a = -0.75 the cubic does not
  // reproduce a ramp exactly.
  for (int x = 8; x < 56; ++x)
    EXPECT_NEAR(*result.at(x, 1), (static_cast<float>(x) + 0.5f) / 2 - 0.5f, 0.05f);
}

TEST(FitLongerSide, ShrinksInProportionAndNeverEnlarges) {
  EXPECT_EQ(fit_longer_side(noise(100, 50, 3), 40).size(), (Size{40, 20}));
  EXPECT_EQ(fit_longer_side(noise(50, 100, 3), 40).size(), (Size{20, 40}));
  EXPECT_EQ(fit_longer_side(noise(1000, 2, 1), 10).size(), (Size{10, 1}));
  const Image image = noise(30, 20, 2);
  EXPECT_EQ(fit_longer_side(image, 30), image);
  EXPECT_EQ(fit_longer_side(image, 1000), image);
}

TEST(Resize, WrongSizes) {
  EXPECT_THAT(error_of([] { resize(noise(2, 2, 1), {0, 3}); }), HasSubstr("0×3"));
  EXPECT_THAT(error_of([] { resize(noise(2, 2, 1), {3, -1}); }), HasSubstr("3×-1"));
  EXPECT_THAT(error_of([] { resize(Image(), {3, 3}); }), HasSubstr("empty"));
  EXPECT_THAT(error_of([] { fit_longer_side(noise(2, 2, 1), 0); }), HasSubstr("0 pixels"));
}

}  // namespace
}  // namespace gramloom
