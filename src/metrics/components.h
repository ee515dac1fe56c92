#pragma once

#include "core/image.h"
#include "signal/colour_pca.h"

namespace gramloom {

/// Both images are scored along the exemplar's first principal axes of colour, in units of its
/// total deviation (the root of the summed variances), from its mean. So any offset, gain or number
/// of channels is treated alike. What lies along further axes is seen by colour_wasserstein alone.
struct ColourFrame {
  ColourPca pca;
  double scale = 1;  // 1 / total deviation
};

inline constexpr int component_count = 4;
/// Smallest side of component images; smaller pictures are continued by mirroring.
inline constexpr int smallest_scored_side = 16;

/// A flat exemplar counts as varying by a thousandth of its largest value.
ColourFrame colour_frame(const Image& exemplar);

/// `component_count` channels (those beyond the image's are 0), at least `smallest_scored_side` on
/// a side.
Image components(const Image& image, const ColourFrame& frame);

/// Half the size (rounded up), smoothed by a Gaussian of 1.2 pixels: so little is left above the
/// new grid's highest frequency that statistics don't depend on where the samples fall.
Image smoothly_halved(const Image& components);

}  // namespace gramloom
