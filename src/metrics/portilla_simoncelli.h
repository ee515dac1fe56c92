#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "metrics/bands.h"

namespace gramloom {

/// Statistics of the kind that Portilla & Simoncelli 2000, "A parametric texture model based on
/// joint statistics of complex wavelet coefficients", IJCV 40(1), section 3, impose on a texture.
/// One vector a group, in the same order for every image of one number of levels.
struct TextureStatistics {
  std::vector<double> marginals;        // mean, log deviation, skewness and kurtosis (damped) of
                                        // the plane; the latter two of its halved versions
  std::vector<double> energies;         // log deviation of each band
  std::vector<double> low_pass_lags;    // autocorrelation of the plane and its halved versions
  std::vector<double> magnitude_lags;   // of each band's magnitude; lags to 3 samples
  std::vector<double> magnitude_pairs;  // correlation of magnitudes within and between scales
  std::vector<double> phases;           // of each band with the next coarser one's doubled phase
};

/// Of a plane in the exemplar's deviations. Departures from the paper: lags to 3 samples at all
/// scales; low-pass images by binomial filters; skewness s counts as s/(1 + |s|), kurtosis as its
/// logarithm, so that one bright pixel doesn't decide; colour is left to other scores.
TextureStatistics texture_statistics(const cv::Mat& plane, const Bands& bands);

/// The mean over the groups of the root mean squared difference: 0 for equal statistics; each group
/// is of order 1.
double statistics_distance(const TextureStatistics& a, const TextureStatistics& b);

}  // namespace gramloom
