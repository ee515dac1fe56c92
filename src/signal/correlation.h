#pragma once

#include <opencv2/core.hpp>

#include "core/image.h"

namespace gramloom {

/// Correlation of two images at every shift at which they overlap by at least a quarter of the
/// smaller one's area: Σ a b / √(Σ a² Σ b²) over the overlap and all components, less each image's
/// mean; 0 elsewhere, and where an overlap is flat.
struct ShiftCorrelation {
  cv::Mat1f values;
  int left = 0, top = 0;  // the shift of values(0, 0)

  /// Of a(x + dx, y + dy) with b(x, y); 0 outside.
  float at(int dx, int dy) const {
    const int x = dx - left, y = dy - top;
    return x >= 0 && y >= 0 && x < values.cols && y < values.rows ? values(y, x) : 0.0f;
  }
};
ShiftCorrelation shift_correlation(const Image& a, const Image& b);

/// The strongest correlation at any shift, in [0, 1].
double strongest_correlation(const ShiftCorrelation& correlation);

/// Root mean square of the difference between two images' self-correlations over all shifts of up
/// to a quarter of the exemplar's (or, where it is smaller, the image's) sides: between 0 and 2.
double autocorrelation_distance(const ShiftCorrelation& exemplar, Size exemplar_size,
                                const ShiftCorrelation& image, Size image_size);

/// The strongest self-correlation at shifts of more than an eighth of `side` along an axis.
double repetition(const ShiftCorrelation& self, int side);

}  // namespace gramloom
