#include "classic/phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace gramloom {
namespace {

Image noise(Size size, int channels, std::uint64_t seed) {
  Image image(size, channels);
  Random random(seed);
  for (float& v : image.pixels) v = random.uniform();
  return image;
}

using Spectrum = std::vector<std::complex<double>>;

/// By the definition, in double.
Spectrum fourier(const Image& image, int channel) {
  const int w = image.width, h = image.height;
  const auto turn = [](int k, int n) {
    return std::polar(1.0, -2 * std::numbers::pi * (k % n) / n);
  };
  Spectrum rows(image.pixels.size() / static_cast<std::size_t>(image.channels));
  Spectrum all(rows.size());
  for (int y = 0; y < h; ++y)
    for (int u = 0; u < w; ++u)
      for (int x = 0; x < w; ++x)
        rows[static_cast<std::size_t>(y * w + u)] +=
            static_cast<double>(image.at(x, y)[channel]) * turn(u * x, w);
  for (int u = 0; u < w; ++u)
    for (int v = 0; v < h; ++v)
      for (int y = 0; y < h; ++y)
        all[static_cast<std::size_t>(v * w + u)] +=
            rows[static_cast<std::size_t>(y * w + u)] * turn(v * y, h);
  return all;
}

class PhaseOfSize : public testing::TestWithParam<Size> {};

TEST_P(PhaseOfSize, KeepsTheSpectrumsModulus) {
  const Image spot = noise(GetParam(), 2, 1);
  const Image image = random_phase_noise(spot, Random(2));
  for (int c = 0; c < 2; ++c) {
    const Spectrum before = fourier(spot, c), after = fourier(image, c);
    double energy = 0;
    for (std::size_t i = 1; i < before.size(); ++i) energy += std::norm(before[i]);
    const double rms = std::sqrt(energy / static_cast<double>(before.size()));
    for (std::size_t i = 0; i < before.size(); ++i)
      ASSERT_NEAR(std::abs(before[i]), std::abs(after[i]),
                  1e-5 * std::max(rms, std::abs(before[i])))
          << i;
    EXPECT_NEAR(before[0].real(), after[0].real(), 1e-5 * std::abs(before[0]));
  }
}

TEST_P(PhaseOfSize, AddsTheSamePhaseToEachChannel) {
  const Image spot = noise(GetParam(), 2, 3);
  const Image image = random_phase_noise(spot, Random(4));
  const Spectrum a = fourier(spot, 0), b = fourier(spot, 1);
  const Spectrum c = fourier(image, 0), d = fourier(image, 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_LT(std::abs(a[i] * std::conj(b[i]) - c[i] * std::conj(d[i])),
              1e-4 * std::abs(a[i] * std::conj(b[i])) + 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Sizes, PhaseOfSize,
                         testing::Values(Size{32, 24}, Size{31, 24}, Size{32, 25}, Size{27, 33},
                                         Size{74, 37}, Size{1, 16}, Size{16, 1}, Size{2, 2}));

TEST(Phase, SynthesisOfTheExemplarsSizeHasItsPeriodicComponentsSpectrum) {
  // Noise around ½ with one black and one white pixel: nothing reaches the ends of the range, so
  // the clamp does nothing.
  Image exemplar = noise({40, 32}, 1, 5);
  for (float& v : exemplar.pixels) v = 0.45f + 0.1f * v;
  exemplar.pixels[100] = 0;
  exemplar.pixels[101] = 1;
  const Image image =
      synthesise(PhaseParams{}, {{{exemplar}}, Target{{40, 32}}, Random(6)}, Control{}).image;
  const Spectrum before = fourier(periodic_component(exemplar), 0), after = fourier(image, 0);
  double rms = 0;
  for (std::size_t i = 1; i < before.size(); ++i) rms += std::norm(before[i]);
  rms = std::sqrt(rms / static_cast<double>(before.size()));
  for (std::size_t i = 0; i < before.size(); ++i)
    ASSERT_NEAR(std::abs(before[i]), std::abs(after[i]), 1e-5 * std::max(rms, std::abs(before[i])));
}

TEST(PeriodicComponent, SolvesMoisansEquation) {
  // u = p + s, where the periodic Laplacian of s is the jump across the image's edges.
  const Image u = noise({24, 17}, 1, 7);
  const Image p = periodic_component(u);
  const int w = u.width, h = u.height;
  const auto value = [&](const Image& image, int x, int y) {
    return static_cast<double>(*image.at((x + w) % w, (y + h) % h));
  };
  const auto smooth = [&](int x, int y) { return value(u, x, y) - value(p, x, y); };
  double sum = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      sum += smooth(x, y);
      const double laplacian = smooth(x - 1, y) + smooth(x + 1, y) + smooth(x, y - 1) +
                               smooth(x, y + 1) - 4 * smooth(x, y);
      double jump = 0;
      if (x == 0 || x == w - 1) jump += value(u, w - 1 - x, y) - value(u, x, y);
      if (y == 0 || y == h - 1) jump += value(u, x, h - 1 - y) - value(u, x, y);
      ASSERT_NEAR(laplacian, jump, 2e-6) << x << " " << y;
    }
  EXPECT_NEAR(sum, 0, 1e-4);
}

TEST(Phase, LargerAndSmallerResultsKeepMeanVarianceAndNeighboursCorrelation) {
  // Averages over 8 pixels have a correlation of 7/8 with their right neighbour.
  const Image white = noise({160 + 8, 128}, 1, 8);
  Image exemplar({160, 128}, 1);
  for (int y = 0; y < exemplar.height; ++y)
    for (int x = 0; x < exemplar.width; ++x)
      for (int k = 0; k < 8; ++k) *exemplar.at(x, y) += *white.at(x + k, y) / 8;
  for (const auto& [size, tile] : {std::pair{Size{400, 300}, Tile::none},
                                   {Size{320, 128}, Tile::both},
                                   {Size{100, 90}, Tile::both},
                                   {Size{100, 300}, Tile::x},
                                   {Size{90, 100}, Tile::none}}) {
    const Image image =
        synthesise(PhaseParams{}, {{{exemplar}}, Target{size, tile}, Random(9)}, Control{}).image;
    const auto moments = [](const Image& of) {
      double mean = 0, square = 0, right = 0;
      for (int y = 0; y < of.height; ++y)
        for (int x = 0; x < of.width; ++x) mean += static_cast<double>(*of.at(x, y));
      mean /= of.width * of.height;
      for (int y = 0; y < of.height; ++y)
        for (int x = 0; x + 1 < of.width; ++x) {
          const double here = static_cast<double>(*of.at(x, y)) - mean;
          square += here * here;
          right += here * (static_cast<double>(*of.at(x + 1, y)) - mean);
        }
      return std::array{mean, square / (of.height * (of.width - 1)), right / square};
    };
    const auto expected = moments(exemplar), got = moments(image);
    EXPECT_NEAR(got[0], expected[0], 0.01) << size.width;
    EXPECT_NEAR(got[1] / expected[1], 1, 0.1) << size.width;
    EXPECT_NEAR(got[2], 7.0 / 8, 0.015) << size.width;
  }
}

}  // namespace
}  // namespace gramloom
