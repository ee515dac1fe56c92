#include "signal/correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "signal/grain.h"

namespace gramloom {
namespace {

Image centred(Image image) {
  for (int c = 0; c < image.channels; ++c) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) sum += double{image.at(x, y)[c]};
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        image.at(x, y)[c] -= static_cast<float>(sum / (image.width * image.height));
  }
  return image;
}

TEST(Correlation, EqualsTheSumsAtEveryShift) {
  const Image a = centred(grain({17, 12}, 2, 1)), b = centred(grain({9, 14}, 2, 2));
  const ShiftCorrelation correlation = shift_correlation(a, b);
  for (int dy = -20; dy <= 20; ++dy)
    for (int dx = -20; dx <= 20; ++dx) {
      double ab = 0, aa = 0, bb = 0;
      int overlap = 0;
      for (int y = 0; y < b.height; ++y)
        for (int x = 0; x < b.width; ++x) {
          if (x + dx < 0 || y + dy < 0 || x + dx >= a.width || y + dy >= a.height) continue;
          ++overlap;
          for (int c = 0; c < 2; ++c) {
            const double u = double{a.at(x + dx, y + dy)[c]}, v = double{b.at(x, y)[c]};
            ab += u * v;
            aa += u * u;
            bb += v * v;
          }
        }
      const double expected = 4 * overlap < 9 * 14 ? 0 : ab / std::sqrt(aa * bb);
      ASSERT_NEAR(correlation.at(dx, dy), expected, 1e-5) << dx << " " << dy;
    }
}

TEST(Correlation, FindsAPieceAtItsShift) {
  const Image a = grain({60, 50}, 1);
  const Image piece = window(a, 22, 13, {25, 20});
  const ShiftCorrelation correlation = shift_correlation(a, piece);
  EXPECT_GT(correlation.at(22, 13), 0.98f);
  EXPECT_EQ(strongest_correlation(correlation), double{correlation.at(22, 13)});
}

// A wave's self-correlation is a cosine of the shift.
TEST(Correlation, AutocorrelationOfWaves) {
  const auto wave = [](double period) {
    Image image(96, 96, 1);
    for (int y = 0; y < 96; ++y)
      for (int x = 0; x < 96; ++x)
        *image.at(x, y) = static_cast<float>(std::sin(2 * std::numbers::pi * x / period));
    return image;
  };
  const ShiftCorrelation a = shift_correlation(wave(8), wave(8));
  const ShiftCorrelation b = shift_correlation(wave(12), wave(12));
  EXPECT_NEAR(a.at(4, 0), -1, 0.01);
  EXPECT_NEAR(a.at(8, 3), 1, 0.01);
  EXPECT_NEAR(a.at(2, 0), 0, 0.03);
  EXPECT_EQ(autocorrelation_distance(a, {96, 96}, a, {96, 96}), 0);
  // Independent cosines of mean square ½ differ by 1 in root mean square.
  EXPECT_NEAR(autocorrelation_distance(a, {96, 96}, b, {96, 96}), 1, 0.1);
}

TEST(Correlation, RepetitionOfATile) {
  const Image tile = grain({32, 32}, 1);
  const Image tiled = window(tile, 0, 0, {96, 96});
  EXPECT_GT(repetition(shift_correlation(tiled, tiled), 32), 0.999);
  const Image fresh = grain({96, 96}, 1);
  EXPECT_LT(repetition(shift_correlation(fresh, fresh), 32), 0.15);
}

}  // namespace
}  // namespace gramloom
