#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/image.h"

namespace gramloom {

/// How far the already filled part of a patch reaches in from each side, in pixels. Opposite sides
/// do not meet: left + right ≤ width, top + bottom ≤ height.
struct Sides {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  bool any() const { return left > 0 || top > 0 || right > 0 || bottom > 0; }
  /// Whether pixel (x, y) of a patch lies in the filled part.
  bool covers(int x, int y, Size patch) const {
    return x < left || y < top || x >= patch.width - right || y >= patch.height - bottom;
  }
};

/// The overlap errors of a patch against every position of an exemplar at once,
///   error(u, v) = Σ_{(x, y) filled} Σ_c (exemplar_c(u + x, v + y) − patch_c(x, y))²
///               = Σ exemplar² − 2 Σ exemplar · patch + Σ patch².
/// The first sum comes from a summed-area table. The second, a correlation with thin strips, comes
/// from one-dimensional Fourier transforms along the strips (rows for top and bottom, columns for
/// left and right), which costs overlap · channels products a position instead of a whole strip's;
/// strips of opposite sides share one inverse transform.
class OverlapErrors {
 public:
  /// `patch` fits into the exemplar.
  OverlapErrors(const Image& exemplar, Size patch);

  /// Number of patch positions in each direction: exemplar − patch + 1.
  Size positions() const { return positions_; }
  /// The exemplar's variance for each filled pixel: half the error of unrelated patches.
  float scale(const Sides& sides) const;
  /// What rounding may add to an error: 1e-5 of the exemplar's variance for each filled pixel.
  float noise(const Sides& sides) const;

  /// errors[v · positions().width + u] of `patch`, of which `sides` are filled; never negative.
  void compute(const Image& patch, const Sides& sides, std::vector<float>& errors) const;

 private:
  /// Spectra of an image's rows: [row][channel][real, imaginary][frequency], 64 bytes aligned.
  struct Spectra {
    int length = 0;  // of the transform
    int channels = 0;
    cv::Mat1f values;

    int frequencies() const;
    const float* at(int row, int channel) const;
  };
  /// Rows of a patch that are filled.
  struct Band {
    int first = 0;
    int last = 0;  // exclusive
  };

  static Spectra spectra_of_rows(const Image& image, int length);
  Image centred(const Image& image, const Sides& sides) const;
  void add_energies(const Sides& sides, double patch_energy, std::vector<float>& errors) const;
  void subtract_correlations(const Spectra& exemplar, const Image& patch,
                             const std::vector<Band>& bands, Size valid, bool transposed,
                             std::vector<float>& errors) const;

  Size patch_;
  Size positions_;
  double variance_ = 0;  // summed over the channels
  std::vector<float> mean_;
  std::vector<double> energy_sums_;  // summed-area table of Σ_c (exemplar − mean)²
  Spectra rows_;
  Spectra columns_;
};

}  // namespace gramloom
