#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/image.h"

namespace gramloom {

/// The errors of a patch of which every pixel counts by a weight of its own, against every position
/// of an exemplar at once:
///   error(u, v) = Σ_{(x, y)} weight(x, y) Σ_c (exemplar_c(u + x, v + y) − patch_c(x, y))²
///               = Σ weight · exemplar² − 2 Σ exemplar · (weight · patch) + Σ weight · patch².
/// Both sums over the exemplar are correlations, by two-dimensional Fourier transforms of blocks of
/// it (overlap and save) whose products are added up before the one transform back. OverlapErrors
/// does the same for patches that are filled along their sides alone, in less time.
class WeightedErrors {
 public:
  /// `patch` fits into the exemplar.
  WeightedErrors(const Image& exemplar, Size patch);

  /// Number of patch positions in each direction: exemplar − patch + 1.
  Size positions() const { return {across_.positions, down_.positions}; }
  /// The exemplar's variance, summed over the channels.
  double variance() const { return variance_; }

  /// errors[v · positions().width + u] += factor · error(u, v), which is never negative. A weight a
  /// pixel of the patch, row by row.
  void add_to(std::vector<float>& errors, const Image& patch, const std::vector<float>& weights,
              float factor) const;

 private:
  /// How blocks cover the positions of one axis.
  struct Axis {
    int positions = 0;
    int valid = 0;   // positions of a block
    int length = 0;  // of its transform

    int count() const { return (positions + valid - 1) / valid; }
  };
  static Axis cover(int exemplar, int patch);
  /// As cv::dft() takes it, which refuses it for a single column.
  int nonzero_rows(int rows) const { return across_.length > 1 ? rows : 0; }
  cv::Mat spectrum(const cv::Mat& plane, int rows) const;

  Size patch_;
  Axis across_, down_;
  double variance_ = 0;
  std::vector<float> mean_;
  std::vector<cv::Mat> spectra_;  // [block][channel, then the energy]
};

}  // namespace gramloom
