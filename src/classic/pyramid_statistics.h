#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "core/request.h"
#include "signal/layer_axes.h"
#include "signal/steerable_pyramid.h"

namespace gramloom {

/// What is kept of one colour axis of an exemplar: its values and those of its bands, sorted.
struct PyramidHistograms {
  std::vector<float> pixels;
  std::vector<std::vector<float>> bands;
};

/// What a pyramid's texture is to have: the histograms of one exemplar, of several as if they were
/// one, or those of several mixed by weights that are everywhere the same.
///
/// Only usable pixels count: of bands those whose place is usable. Masked places hold the nearest
/// usable pixel's values while the bands are made. Axes are those of all usable pixels; where they
/// are mixed, each exemplar's less its mean.
/// Mixed, quantile functions are averaged: the barycentre of distributions of one dimension (Rabin,
/// Peyré, Delon, Bernot 2012, "Wasserstein barycenter and its application to texture mixing").
class PyramidStatistics {
 public:
  /// Keeps the exemplars' address. shares: of each exemplar, their sum 1; empty: they are one.
  PyramidStatistics(const std::vector<Exemplar>& exemplars, std::vector<double> shares, int levels,
                    int orientations);

  const LayerAxes& axes() const { return axes_; }

  /// Of one axis: one set, or one an exemplar where these are mixed.
  std::vector<PyramidHistograms> of_axis(int axis) const;

  /// Gives a plane, or a band of it, its histogram.
  void match_plane(cv::Mat& plane, const std::vector<PyramidHistograms>& histograms) const;
  void match_band(cv::Mat& band, const std::vector<PyramidHistograms>& histograms,
                  std::size_t index) const;
  /// Gives each channel of a result its histogram.
  void match_channels(Image& image) const;

 private:
  struct Part {
    const Exemplar& exemplar;
    Image axes;  // its values along them
    SteerablePyramid pyramid;
  };
  using Sorted = std::vector<const std::vector<float>*>;

  PyramidHistograms analyse(const Part& part, int axis) const;
  void match(std::span<float> values, const Sorted& sorted) const;

  const std::vector<Exemplar>& exemplars_;
  std::vector<double> shares_;
  LayerAxes axes_;
  std::vector<Part> parts_;
};

}  // namespace gramloom
