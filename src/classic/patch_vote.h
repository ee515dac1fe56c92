#pragma once

#include <vector>

#include "core/image.h"
#include "signal/patch_field.h"

namespace gramloom {

/// The canvas that fits the field's patches best: each pixel is the mean of what the patches over
/// it say, weighted by (distance² + floor)^((r − 2) / 2), the reweighted least squares of Kwatra,
/// Essa, Bobick, Kwatra 2005 ("Texture optimization for example-based synthesis", section 3.1).
/// r is 0.75 instead of their 0.8: square roots suffice for it, the same on every machine.
Image vote(const PatchField& field, const Image& exemplar, float floor);
/// The same, in the place of the canvas before. Of a canvas some of whose pixels are known, only
/// those are changed that are `made` (of the texture's size, row by row; empty: all).
void vote(const PatchField& field, const Image& exemplar, float floor, Image& canvas,
          const std::vector<unsigned char>& made = {});

/// Each pixel's origin in the exemplar, x and y: of the pixels that the patches over it say, the
/// one nearest to their weighted mean, so that every pixel is one of the exemplar's and sharp (as
/// Han et al. 2006, "Fast example-based surface texture synthesis via discrete optimization").
/// `canvas` is what vote() gave. Row by row, without the canvas's repeated border; distances are
/// not looked at.
std::vector<SmallOrigin> choose_pixels(const PatchField& field, const Image& canvas,
                                       const Image& exemplar);

/// Squared weights of the pixels' differences in the guide, of the texture's size; see PatchGuide.
struct GuidedPixels {
  const PatchGuide& guide;
  const Image& weight;
};
/// The same for pixels that are `made` (others are at (0, 0)), where what a pixel's guide asks for
/// counts as its mean does: a label ends at the pixel where it is to end.
std::vector<SmallOrigin> choose_pixels(const PatchField& field, const Image& canvas,
                                       const PatchSource& source, const GuidedPixels& guided,
                                       const std::vector<unsigned char>& made);

/// Energy that vote() and improve() lower in turn: Σ (distance² + floor)^(r / 2).
double robust_energy(const PatchField& field, float floor);

/// Size of the texture without the border that the canvas repeats.
Size texture_size(const PatchField& field);

}  // namespace gramloom
