#include "signal/fourier.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <utility>

#include "core/random.h"

namespace gramloom {
namespace {

class FourierOfSize : public testing::TestWithParam<Size> {};

TEST_P(FourierOfSize, EqualsTheDefinitionAndComesBack) {
  const auto [width, height] = GetParam();
  cv::Mat plane(height, width, CV_32F);
  Random random(1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) plane.at<float>(y, x) = random.uniform();
  const cv::Mat coefficients = fourier_coefficients(plane);
  for (const auto& [k, l] : {std::pair{0, 0},
                             {1, 0},
                             {0, 1},
                             {5, 3},
                             {width / 2, height / 2},
                             {width / 3, height - 1}}) {
    if (k > width / 2 || l >= height) continue;
    std::complex<double> sum;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        sum += static_cast<double>(plane.at<float>(y, x)) *
               std::polar(1.0, -2 * std::numbers::pi *
                                   (static_cast<double>(k * x % width) / width +
                                    static_cast<double>(l * y % height) / height));
    sum /= static_cast<double>(plane.total());
    const std::complex<double> got(coefficients.at<Complex>(l, k));
    EXPECT_LT(std::abs(got - sum), 1e-7) << k << " " << l;
  }
  // Only columns 0 to width/2 are read.
  if (width > 2) coefficients.colRange(width / 2 + 1, width).setTo(1e6);
  EXPECT_LT(cv::norm(from_fourier_coefficients(coefficients), plane, cv::NORM_INF), 2e-6);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FourierOfSize,
                         testing::Values(Size{64, 48}, Size{63, 45}, Size{64, 37}, Size{37, 64},
                                         Size{101, 82}, Size{82, 101}, Size{1, 41}, Size{41, 1},
                                         Size{1, 1}, Size{2, 3}));

TEST(Fourier, PeriodsAreTheTargetsWhereItTilesAndFastElsewhere) {
  EXPECT_EQ(period_for(64, 101, true), 101);
  EXPECT_EQ(period_for(101, 64, true), 64);
  EXPECT_EQ(period_for(101, 64, false), 101);
  EXPECT_EQ(period_for(64, 101, false), 108);
}

}  // namespace
}  // namespace gramloom
