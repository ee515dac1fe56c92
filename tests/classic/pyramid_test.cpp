#include "classic/pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "signal/fourier.h"
#include "signal/histogram_match.h"
#include "signal/steerable_pyramid.h"

namespace gramloom {
namespace {

Image white_noise(Size size, int channels, std::uint64_t seed) {
  Image image(size, channels);
  Random random(seed);
  for (float& v : image.pixels) v = random.uniform();
  return image;
}

struct PyramidCase {
  Size size;
  int levels;
  int orientations;
};

class SteerablePyramidOf : public testing::TestWithParam<PyramidCase> {};

TEST_P(SteerablePyramidOf, ReconstructsPerfectly) {
  const auto& [size, levels, orientations] = GetParam();
  const auto pyramid = steerable_pyramid(size, levels, orientations);
  ASSERT_EQ(pyramid.bands.size(), static_cast<std::size_t>(levels * orientations + 2));
  const cv::Mat plane = channel_plane(white_noise(size, 1, 1), 0);
  const cv::Mat coefficients = fourier_coefficients(plane);
  cv::Mat sum = cv::Mat::zeros(size.height, size.width, CV_32FC2);
  for (const auto& band : pyramid.bands) {
    const cv::Mat samples = band_of(coefficients, band);
    ASSERT_EQ(samples.cols, band.grid.width);
    add_band(sum, fourier_coefficients(samples), band);
  }
  EXPECT_LT(cv::norm(from_fourier_coefficients(sum), plane, cv::NORM_INF), 1e-5);
}

TEST_P(SteerablePyramidOf, KeepsEnergy) {
  // A tight frame: the bands' energies (mean squares) add up to the image's.
  const auto& [size, levels, orientations] = GetParam();
  const cv::Mat plane = channel_plane(white_noise(size, 1, 2), 0);
  const auto energy = [](const cv::Mat& m) { return m.dot(m) / static_cast<double>(m.total()); };
  double sum = 0;
  for (const auto& band : steerable_pyramid(size, levels, orientations).bands)
    sum += energy(band_of(fourier_coefficients(plane), band));
  EXPECT_NEAR(sum, energy(plane), 1e-5 * energy(plane));
}

// A band's grid may be larger than the picture, whose coefficients are given as the half that
// counts.
TEST_P(SteerablePyramidOf, ReadsAndWritesNothingBesideTheCoefficients) {
  const auto& [size, levels, orientations] = GetParam();
  const cv::Mat coefficients = fourier_coefficients(channel_plane(white_noise(size, 1, 3), 0));
  const cv::Rect inside(0, 0, size.width / 2 + 1, size.height);
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  cv::Mat room(size.height + 2, size.width + 2, CV_32FC2, cv::Scalar::all(nothing));
  coefficients(inside).copyTo(room(inside));
  cv::Mat sum(room.size(), CV_32FC2, cv::Scalar::all(-0.0));
  cv::Mat sum_inside = sum(inside);
  for (const auto& band : steerable_pyramid(size, levels, orientations).bands) {
    const cv::Mat samples = band_of(room(inside), band);
    EXPECT_EQ(cv::norm(samples, band_of(coefficients, band), cv::NORM_INF), 0);
    add_band(sum_inside, fourier_coefficients(samples), band);
  }
  for (int y = 0; y < sum.rows; ++y)
    for (int x = 0; x < sum.cols; ++x)
      EXPECT_TRUE(inside.contains({x, y}) || std::signbit(sum.at<cv::Vec2f>(y, x)[0]));
}

INSTANTIATE_TEST_SUITE_P(Sizes, SteerablePyramidOf,
                         testing::Values(PyramidCase{{128, 128}, 4, 4},
                                         PyramidCase{{128, 96}, 5, 6}, PyramidCase{{101, 67}, 4, 4},
                                         PyramidCase{{100, 75}, 3, 3}, PyramidCase{{64, 64}, 1, 1},
                                         PyramidCase{{33, 1}, 2, 4}, PyramidCase{{1, 1}, 1, 4},
                                         PyramidCase{{7, 6}, 3, 2}));

TEST(SteerablePyramid, BandsAnswerToTheirScaleAndDirection) {
  // Waves across x of 4, 8 and 16 pixels: strongest at level 0, 1, 2, orientation 0.
  const auto pyramid = steerable_pyramid({128, 128}, 4, 4);
  for (int level = 0; level < 3; ++level) {
    cv::Mat wave(128, 128, CV_32F);
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 128; ++x)
        wave.at<float>(y, x) = static_cast<float>(std::cos(2 * CV_PI * x / (4 << level)));
    std::vector<double> energy;
    for (const auto& band : pyramid.bands) {
      const cv::Mat samples = band_of(fourier_coefficients(wave), band);
      energy.push_back(samples.dot(samples) / static_cast<double>(samples.total()));
    }
    const auto largest = std::max_element(energy.begin(), energy.end()) - energy.begin();
    EXPECT_EQ(largest, 1 + 4 * level);
    // At 90° nothing, at ±45° cos⁶ 45° = 1/8 of it.
    const auto at = [&](int q) { return energy[static_cast<std::size_t>(1 + 4 * level + q)]; };
    EXPECT_LT(at(2), 1e-9);
    EXPECT_NEAR(at(1) / at(0), 0.125, 1e-4);
    EXPECT_NEAR(at(3) / at(0), 0.125, 1e-4);
  }
}

TEST(Pyramid, HistogramsEndEqual) {
  const Image exemplar = white_noise({48, 40}, 3, 3);
  for (const Size size : {Size{48, 40}, Size{40, 48}, Size{90, 70}}) {
    const Image image =
        synthesise(PyramidParams{}, {{{exemplar}}, Target{size}, Random(1)}, Control{}).image;
    for (int c = 0; c < 3; ++c) {
      const auto got = sorted_values(extract_channels(image, c, 1).pixels);
      auto expected = got;
      match_values(expected, sorted_values(extract_channels(exemplar, c, 1).pixels));
      EXPECT_EQ(got, expected);
    }
  }
}

/// Mean squares of the bands of one channel.
std::vector<double> band_energies(const Image& image, const SteerablePyramid& pyramid) {
  const cv::Mat coefficients = periodic_coefficients(channel_plane(image, 0));
  std::vector<double> energies;
  for (const auto& band : pyramid.bands) {
    const cv::Mat samples = band_of(coefficients, band);
    energies.push_back(samples.dot(samples) / static_cast<double>(samples.total()));
  }
  return energies;
}

TEST(Pyramid, ConvergesToTheBandsOfAnOrientedTexture) {
  // Short streaks along x: noise averaged over 9 × 1 pixels.
  const Image white = white_noise({128 + 8, 128}, 1, 4);
  Image exemplar({128, 128}, 1);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      for (int k = 0; k < 9; ++k) *exemplar.at(x, y) += *white.at(x + k, y) / 9;
  const auto pyramid = steerable_pyramid({128, 128}, 3, 4);
  const auto wanted = band_energies(exemplar, pyramid);
  const auto off = [&](int iterations) {  // share of the energy that sits in the wrong band
    PyramidParams params;
    params.iterations = iterations;
    const auto got = band_energies(
        synthesise(params, {{{exemplar}}, Target{{128, 128}}, Random(2)}, Control{}).image,
        pyramid);
    double sum = 0, total = 0;
    for (std::size_t b = 0; b + 1 < got.size(); ++b) {  // the low-pass is mostly the mean
      sum += std::abs(got[b] - wanted[b]);
      total += wanted[b];
    }
    return sum / total;
  };
  const double once = off(1), few = off(5), many = off(20);
  EXPECT_LT(few, once / 3);
  EXPECT_LT(few, 0.1);
  EXPECT_LT(many, few / 2);
}

TEST(Pyramid, ColoursStayCorrelated) {
  // Two channels of the same grain, one of it inverted: their sum is flat, and stays so.
  Image exemplar = white_noise({64, 64}, 2, 5);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) exemplar.at(x, y)[1] = 1 - exemplar.at(x, y)[0];
  const Image image =
      synthesise(PyramidParams{}, {{{exemplar}}, Target{{64, 64}}, Random(3)}, Control{}).image;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) ASSERT_NEAR(image.at(x, y)[0] + image.at(x, y)[1], 1, 1e-3);
}

}  // namespace
}  // namespace gramloom
