// Scores whose value is known on small cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metrics/bands.h"
#include "metrics/components.h"
#include "metrics/pictures.h"
#include "metrics/seams.h"
#include "metrics/spectrum.h"
#include "metrics/stsim.h"
#include "metrics/wasserstein.h"
#include "signal/fourier.h"

namespace gramloom {
namespace {

Image less(Image image, float offset) {
  for (float& v : image.pixels) v -= offset;
  return image;
}

double colour_distance(const Image& a, const Image& b, double scale) {
  return colour_wasserstein(colour_projections(a, scale), colour_projections(b, scale));
}

double spectrum_difference(const Image& a, const Image& b) {
  const int side = std::min({a.width, a.height, b.width, b.height});
  return spectrum_distance(ring_densities(a, side), ring_densities(b, side));
}

TEST(Wasserstein, DistanceOfLists) {
  EXPECT_EQ(quantile_distance({1, 2, 3}, {1, 2, 3}), 0);
  EXPECT_EQ(quantile_distance({1, 2, 3}, {3, 4, 5}), 2);
  EXPECT_EQ(quantile_distance({0, 0}, {0, 1}), 0.5);
  EXPECT_EQ(quantile_distance({0, 1, 2, 3}, {0.5, 2.5}), 0);  // its ranks are their middles
  EXPECT_EQ(quantile_distance({5}, {1, 2, 3}), 3);
}

TEST(Wasserstein, ColoursShiftedByAConstant) {
  const Image image = grain({20, 30}, 1);
  Image brighter = image;
  for (float& v : brighter.pixels) v += 0.25f;
  EXPECT_NEAR(colour_distance(image, brighter, 4), 1, 1e-6);
  // Any other arrangement of the pixels is the same to it, at any size of a whole number of them.
  EXPECT_EQ(colour_distance(image, window(image, 7, 4, image.size()), 4), 0);
}

TEST(Wasserstein, ContrastOfPatches) {
  // Responses of mean 0 and deviation 1 or 1.5 are |z|·½ apart: √(2/π)/2 for normal ones.
  const Image image = less(grain({128, 128}, component_count, 1, 1.0f), 0.5f);
  Image stronger = image;
  for (float& v : stronger.pixels) v *= 1.5f;
  EXPECT_NEAR(patch_wasserstein(patch_projections(image), patch_projections(stronger)),
              0.5 * std::sqrt(2 / std::numbers::pi), 0.01);
}

TEST(Spectrum, TwiceTheContrastIsSixDecibels) {
  const Image image = less(grain({64, 50}, component_count, 1, 0.5f), 0.5f);
  Image stronger = image;
  for (float& v : stronger.pixels) v *= 2;
  EXPECT_NEAR(spectrum_difference(image, stronger), 20 * std::log10(2.0), 1e-3);
}

TEST(Spectrum, DensityDoesNotDependOnSize) {
  const Image small = less(grain({96, 64}, component_count, 1, 0.5f), 0.5f);
  const Image large = less(grain({250, 300}, component_count, 2, 0.5f), 0.5f);
  EXPECT_LT(spectrum_difference(small, large), 1.2);
}

TEST(Bands, AWaveHasAFlatMagnitudeInQuadrature) {
  // 16 periods along x, in the middle of level 0's horizontal band; the first and last columns are
  // equal, so that the periodic component is the wave itself.
  Image image(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      *image.at(x, y) =
          static_cast<float>(std::cos(2 * std::numbers::pi * x / 4 + std::numbers::pi / 4));
  const Bands bands = bands_of(channel_plane(image, 0), 2);
  const Moments m = moments(bands.magnitude[Bands::index(0, 0)]);
  EXPECT_NEAR(m.mean, 2 / std::sqrt(5), 1e-5);  // four cos⁶ add up to 5/4
  EXPECT_NEAR(m.variance, 0, 1e-6);
  EXPECT_NEAR(moments(bands.magnitude[Bands::index(0, 2)]).mean, 0, 1e-5);  // across
}

TEST(Bands, CorrelationsOfSmallPlanes) {
  const cv::Mat a = (cv::Mat_<float>(1, 4) << 1, 2, 3, 4);
  const cv::Mat b = (cv::Mat_<float>(1, 4) << 8, 6, 4, 2);
  EXPECT_NEAR(correlation(a, b), -1, 1e-12);
  EXPECT_NEAR(correlation(a, (cv::Mat_<float>(1, 2) << 0, 5)), 1, 1e-12);  // a's 1 and 3
  EXPECT_EQ(correlation(a, cv::Mat_<float>(1, 4, 7.0f)), 0);
  const cv::Mat alternating = (cv::Mat_<float>(1, 6) << 1, -1, 1, -1, 1, -1);
  const Moments m = moments(alternating);
  EXPECT_NEAR(lag_correlation(alternating, m, 1, 0), -1, 1e-12);
  EXPECT_NEAR(lag_correlation(alternating, m, -2, 0), 1, 1e-12);
  EXPECT_EQ(lag_correlation(alternating, m, 6, 0), 0);
}

TEST(Stsim, IsSymmetricAndBounded) {
  const Image image = pebbles();
  const auto statistics_of = [&](const Image& other) {
    return stsim_statistics(bands_of(channel_plane(components(other, colour_frame(image)), 0), 4));
  };
  const StsimStatistics a = statistics_of(image), b = statistics_of(brick());
  EXPECT_NEAR(stsim2(a, a), 1, 1e-12);
  EXPECT_NEAR(stsim2(a, b), stsim2(b, a), 1e-12);
  EXPECT_GT(stsim2(a, b), 0);
  EXPECT_LT(stsim2(a, b), 0.98);
}

TEST(Seams, ARampMeetsItsOtherEnd) {
  Image ramp(11, 5, 1);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 11; ++x) *ramp.at(x, y) = static_cast<float>(x);
  EXPECT_NEAR(seam_visibility(ramp, true), 10, 1e-12);
  EXPECT_EQ(seam_visibility(ramp, false), 0);
  EXPECT_EQ(seam_visibility(Image(1, 5, 1), true), 0);
  Image halves(2, 1, 1);
  *halves.at(1, 0) = 1;
  EXPECT_EQ(seam_visibility(halves, true), 1);
}

TEST(Seams, AHardSeamIsCaughtAndATilingTextureIsNot) {
  for (const Image& image : {pebbles(), stones(), painted(Granite{}, 5), painted(Clouds{}, 3)}) {
    EXPECT_LT(seam_visibility(image, true), 1.2);
    EXPECT_LT(seam_visibility(image, false), 1.2);
    const Image cut = window(image, 0, 0, {91, 83});
    EXPECT_GT(seam_visibility(cut, true), 1.5);
    EXPECT_GT(seam_visibility(cut, false), 1.5);
  }
}

}  // namespace
}  // namespace gramloom
