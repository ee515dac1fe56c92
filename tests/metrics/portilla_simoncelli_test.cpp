// Statistics of pictures for which they are known.
#include "metrics/portilla_simoncelli.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metrics/components.h"
#include "metrics/controls.h"
#include "metrics/pictures.h"
#include "signal/fourier.h"

namespace gramloom {
namespace {

constexpr int levels = 4;
constexpr int orientations = Bands::orientations;

TextureStatistics statistics_of(const Image& image) {
  const cv::Mat plane = channel_plane(image, 0);
  return texture_statistics(plane, bands_of(plane, levels));
}

/// The first component, as scores see it.
Image plane_of(const Image& exemplar, const Image& image) {
  return components(image, colour_frame(exemplar));
}

Image changed(Image image, const auto& change) {
  for (float& value : image.pixels) value = change(value);
  return image;
}

template <class Value>
Image drawn(int side, const Value& value) {
  Image image(side, side, 1);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) *image.at(x, y) = static_cast<float>(value(x, y));
  return image;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}
double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// Of the bands of the pyramid, after the two residuals.
double band_energy(const TextureStatistics& s, int level, int orientation) {
  return s.energies[2 + Bands::index(level, orientation)];
}

TEST(PortillaSimoncelli, HasOneVectorAGroup) {
  const TextureStatistics s = statistics_of(grain({128, 128}, 1));
  EXPECT_EQ(s.marginals.size(), 2u + 2 * (levels + 1));
  EXPECT_EQ(s.energies.size(), 2u + levels * orientations);
  EXPECT_EQ(s.low_pass_lags.size(), 24u * (levels + 1));  // half of 7×7 shifts
  EXPECT_EQ(s.magnitude_lags.size(), 24u * levels * orientations);
  EXPECT_EQ(s.magnitude_pairs.size(), 6u * levels + 16u * (levels - 1));
  EXPECT_EQ(s.phases.size(), 2u * (levels - 1) * orientations);
}

TEST(PortillaSimoncelli, WhiteNoise) {
  const Image noise = changed(grain({512, 512}, 1, 1, 1.0f), [](float v) { return v - 0.5f; });
  const TextureStatistics s = statistics_of(noise);
  EXPECT_NEAR(s.marginals[0], 0, 0.01);              // mean
  EXPECT_NEAR(s.marginals[1], 0, 0.01);              // log deviation
  EXPECT_NEAR(s.marginals[2], 0, 0.02);              // skewness
  EXPECT_NEAR(s.marginals[3], std::log1p(3), 0.02);  // kurtosis
  for (std::size_t lag = 0; lag < 24; ++lag) EXPECT_NEAR(s.low_pass_lags[lag], 0, 0.01) << lag;
  // All directions have equal power, and an octave below a quarter of it.
  for (int level = 0; level < levels; ++level)
    for (int q = 0; q < orientations; ++q) {
      EXPECT_NEAR(band_energy(s, level, q), band_energy(s, 0, 0) - level * std::log(2), 0.08)
          << level << " " << q;
    }
  // Phases across scales are independent; of the coarsest there are few samples.
  EXPECT_LT(largest(s.phases), 0.15);
}

// cos along x with a period of 4, in the middle of level 0: one band has it, its neighbours see it
// at 45°, the one across doesn't.
TEST(PortillaSimoncelli, AWave) {
  const TextureStatistics s = statistics_of(drawn(128, [](int x, int) {
    return std::cos(2 * std::numbers::pi * x / 4 + std::numbers::pi / 4);
  }));
  EXPECT_NEAR(s.marginals[0], 0, 1e-6);
  EXPECT_NEAR(s.marginals[1], 0.5 * std::log(0.5), 1e-5);
  EXPECT_NEAR(s.marginals[2], 0, 1e-5);
  EXPECT_NEAR(s.marginals[3], std::log1p(1),
              1e-5);  // ±√½: its fourth moment is its variance's square
  std::size_t lag = 0;
  for (int dy = 0; dy <= 3; ++dy)
    for (int dx = dy == 0 ? 1 : -3; dx <= 3; ++dx, ++lag)
      EXPECT_NEAR(s.low_pass_lags[lag], std::cos(2 * std::numbers::pi * dx / 4), 0.02)
          << dx << " " << dy;
  EXPECT_NEAR(band_energy(s, 0, 1) - band_energy(s, 0, 0), 1.5 * std::log(0.5), 1e-3);  // cos³ 45°
  EXPECT_NEAR(band_energy(s, 0, 3) - band_energy(s, 0, 0), 1.5 * std::log(0.5), 1e-3);
  EXPECT_NEAR(band_energy(s, 0, 2), 0.5 * std::log(1e-6), 1e-3);  // nothing
  // Its magnitude is the same everywhere: nothing to correlate.
  EXPECT_LT(largest(s.magnitude_lags), 1e-9);
  EXPECT_LT(largest(s.magnitude_pairs), 1e-9);
}

TEST(PortillaSimoncelli, IsZeroToItselfAndSymmetric) {
  const Image a = pebbles(), b = brick();
  const TextureStatistics of_a = statistics_of(plane_of(a, a)),
                          of_b = statistics_of(plane_of(a, b));
  EXPECT_EQ(statistics_distance(of_a, of_a), 0);
  EXPECT_EQ(statistics_distance(of_a, statistics_of(plane_of(a, a))), 0);
  EXPECT_EQ(statistics_distance(of_a, of_b), statistics_distance(of_b, of_a));
  EXPECT_GT(statistics_distance(of_a, of_b), 0.1);
}

// What lies at the edges differs: a jump there is taken away, and lags end there.
TEST(PortillaSimoncelli, AShiftAroundTheTorusChangesLittle) {
  for (const Image& image : {pebbles(), brick(), stones()}) {
    const Image plane = plane_of(image, image);
    const TextureStatistics s = statistics_of(plane);
    const TextureStatistics shuffled = statistics_of(
        plane_of(image, control_pair(ControlKind::shuffled, image, image.size(), Random(1)).image));
    for (const auto& [x, y] : {std::pair{48, 16}, {7, 10}, {1, 0}})
      EXPECT_LT(statistics_distance(s, statistics_of(window(plane, x, y, plane.size()))),
                0.2 * statistics_distance(s, shuffled))
          << x << " " << y;
  }
}

TEST(PortillaSimoncelli, BrightnessIsInTheMeanAlone) {
  const Image plane = plane_of(pebbles(), pebbles());
  const TextureStatistics s = statistics_of(plane);
  const TextureStatistics brighter =
      statistics_of(changed(plane, [](float v) { return v + 0.5f; }));
  EXPECT_NEAR(brighter.marginals[0], s.marginals[0] + 0.5, 1e-5);
  EXPECT_NEAR(brighter.marginals[1], s.marginals[1], 1e-4);
  EXPECT_LT(largest_difference(s.energies, brighter.energies), 1e-3);
  EXPECT_LT(largest_difference(s.low_pass_lags, brighter.low_pass_lags), 1e-3);
  EXPECT_LT(largest_difference(s.magnitude_lags, brighter.magnitude_lags), 1e-3);
  EXPECT_LT(largest_difference(s.magnitude_pairs, brighter.magnitude_pairs), 1e-3);
  EXPECT_LT(largest_difference(s.phases, brighter.phases), 1e-3);
}

TEST(PortillaSimoncelli, ContrastIsInTheDeviationsAlone) {
  const Image plane = plane_of(pebbles(), pebbles());
  const TextureStatistics s = statistics_of(plane);
  const TextureStatistics stronger = statistics_of(changed(plane, [](float v) { return 2 * v; }));
  EXPECT_NEAR(stronger.marginals[1], s.marginals[1] + std::log(2), 1e-4);
  for (std::size_t i = 2; i < s.marginals.size(); ++i)
    EXPECT_NEAR(stronger.marginals[i], s.marginals[i], 1e-4) << i;
  for (std::size_t i = 0; i < s.energies.size(); ++i)
    EXPECT_NEAR(stronger.energies[i], s.energies[i] + std::log(2), 0.01) << i;
  EXPECT_LT(largest_difference(s.low_pass_lags, stronger.low_pass_lags), 1e-4);
  EXPECT_LT(largest_difference(s.magnitude_lags, stronger.magnitude_lags), 1e-4);
  EXPECT_LT(largest_difference(s.magnitude_pairs, stronger.magnitude_pairs), 1e-4);
  EXPECT_LT(largest_difference(s.phases, stronger.phases), 1e-4);
}

TEST(PortillaSimoncelli, ANegativeTurnsSkewnessAndPhases) {
  const Image plane = plane_of(pebbles(), pebbles());
  const TextureStatistics s = statistics_of(plane);
  const TextureStatistics negative = statistics_of(changed(plane, [](float v) { return -v; }));
  EXPECT_GT(std::abs(s.marginals[2]), 0.1);
  for (std::size_t i = 2; i < s.marginals.size(); i += 2) {
    EXPECT_NEAR(negative.marginals[i], -s.marginals[i], 1e-4) << i;
    EXPECT_NEAR(negative.marginals[i + 1], s.marginals[i + 1], 1e-4) << i;
  }
  EXPECT_GT(largest(s.phases), 0.1);
  for (std::size_t i = 0; i < s.phases.size(); ++i)
    EXPECT_NEAR(negative.phases[i], -s.phases[i], 1e-4) << i;
  EXPECT_LT(largest_difference(s.energies, negative.energies), 1e-4);
  EXPECT_LT(largest_difference(s.low_pass_lags, negative.low_pass_lags), 1e-4);
  EXPECT_LT(largest_difference(s.magnitude_lags, negative.magnitude_lags), 1e-4);
  EXPECT_LT(largest_difference(s.magnitude_pairs, negative.magnitude_pairs), 1e-4);
}

// Edges line up across scales and gather in the same places: what random phases lose, and what
// second-order statistics do not see.
TEST(PortillaSimoncelli, RandomPhasesKeepEnergiesAndLoseWhatEdgesHave) {
  for (const Image& image : {pebbles(), brick()}) {
    const Image plane = plane_of(image, image);
    const TextureStatistics s = statistics_of(plane);
    const TextureStatistics random = statistics_of(
        control_pair(ControlKind::random_phase, plane, plane.size(), Random(1)).image);
    EXPECT_LT(largest_difference(s.energies, random.energies), 0.25);
    for (std::size_t lag = 0; lag < 24; ++lag)  // of the plane itself: many samples
      EXPECT_NEAR(random.low_pass_lags[lag], s.low_pass_lags[lag], 0.1) << lag;
    EXPECT_GT(largest(s.phases), 0.3);
    EXPECT_GT(largest_difference(s.phases, random.phases), 0.3);
    EXPECT_GT(largest_difference(s.magnitude_pairs, random.magnitude_pairs), 0.3);
  }
}

// Rows turned by 90°: other bands, the same marginals.
TEST(PortillaSimoncelli, DirectionsAreInEnergiesAndLags) {
  const auto stripes = [](bool along_x) {
    return drawn(128, [=](int x, int y) {
      return (along_x ? x : y) / 4 % 2 + 0.1 * std::sin(0.37 * x * x + 0.71 * y * y);
    });
  };
  const TextureStatistics a = statistics_of(stripes(true)), b = statistics_of(stripes(false));
  EXPECT_LT(largest_difference(a.marginals, b.marginals), 0.05);
  EXPECT_GT(largest_difference(a.energies, b.energies), 1);
  EXPECT_GT(largest_difference(a.low_pass_lags, b.low_pass_lags), 0.5);
}

}  // namespace
}  // namespace gramloom
