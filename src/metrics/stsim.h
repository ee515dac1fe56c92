#pragma once

#include <vector>

#include "metrics/bands.h"

namespace gramloom {

/// STSIM-2, the structural texture similarity of Zujovic, Pappas, Neuhoff 2013, "Structural texture
/// similarity metrics for image analysis and retrieval", IEEE Transactions on Image Processing
/// 22(7), equations 6 to 17: the mean over all bands of (l c c₀₁ c₁₀)^¼, which compare mean,
/// variance and the autocorrelations at one sample down and to the right, and over pairs of bands
/// of 1 − |ρx − ρy|/2, which compare the correlations of magnitudes, between orientations of one
/// scale and between scales of one orientation. 1 for equal statistics, 0 at worst.
/// Departures: statistics of the whole image at once, which sizes that differ ask for; up to four
/// scales rather than three; the grey values have mean 4 and deviation 1 on the exemplar, so that
/// they don't depend on a picture's offset and contrast (see stsim_plane).
struct StsimStatistics {
  struct Band {
    double mean, deviation, down, right;  // the latter two: autocorrelations
  };
  std::vector<Band> bands;    // high-pass, low-pass, then the oriented ones
  std::vector<double> pairs;  // correlations of magnitudes: of each band with those after it
};
StsimStatistics stsim_statistics(const Bands& bands);
double stsim2(const StsimStatistics& exemplar, const StsimStatistics& image);

/// The mean, on the exemplar, of the plane that STSIM-2 is taken of, in its deviations.
inline constexpr double stsim_mean = 4;

}  // namespace gramloom
