#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/image.h"

namespace gramloom {

/// A plane's steerable pyramid (classic/steerable_pyramid.h) in quadrature pairs: `odd` is the
/// pyramid's own band, `even` the response of the same filter a quarter of a wave on, and both
/// together a complex band. Level s is sampled exactly every 2ˢ pixels, so that statistics over
/// samples mean the same for images of different sizes.
struct Bands {
  static constexpr int orientations = 4;
  int levels = 0;
  cv::Mat high, low;                          // CV_32F
  std::vector<cv::Mat> odd, even, magnitude;  // level 0's orientations, level 1's, …

  static std::size_t index(int level, int orientation) {
    return static_cast<std::size_t>(level * orientations + orientation);
  }
};

/// Levels that both images are large enough for, 2 to 4.
int common_levels(Size a, Size b);

/// Of a plane with sides of at least 16 pixels. Up to a few per cent of its right and lower side
/// are cut off to make the grids whole; the periodic component is taken (Moisan 2011), so that
/// opposite edges leave no trace.
Bands bands_of(const cv::Mat& plane, int levels);

/// Correlation of the samples of `a` and of `b` (of one size, or `a` twice as fine as `b` and taken
/// at its samples), in [-1, 1]; 0 where one is flat.
double correlation(const cv::Mat& a, const cv::Mat& b);

/// Mean and variance of all samples.
struct Moments {
  double mean = 0;
  double variance = 0;
};
Moments moments(const cv::Mat& plane);

/// Autocorrelation at the lag (dx, dy), dy ≥ 0, over the samples that have such a neighbour.
double lag_correlation(const cv::Mat& plane, const Moments& of_plane, int dx, int dy);

}  // namespace gramloom
