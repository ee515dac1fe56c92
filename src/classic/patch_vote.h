#pragma once

#include <vector>

#include "core/image.h"
#include "signal/patch_field.h"

namespace gramloom {

/// A canvas has so many more rows and columns than it has patches, where it does not wrap.
inline constexpr int patch_border = field_patch - 1;

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

/// Calls f(origin) for what the patches over pixel (x, y) of a texture say about it; the same ones
/// one after the other are called once.
template <class F>
void for_each_said(const PatchField& field, int x, int y, F&& f) {
  PatchOrigin last_said{-1, -1};
  for (int line = 0; line < field_patch; ++line) {
    int row = y - line;
    if (tiles_y(field.tile))
      row = (row % field.size.height + field.size.height) % field.size.height;
    if (row < 0 || row >= field.size.height) continue;
    for (int i = 0; i < field_patch; ++i) {
      int column = x - i;
      if (tiles_x(field.tile))
        column = (column % field.size.width + field.size.width) % field.size.width;
      if (column < 0 || column >= field.size.width) continue;
      const std::size_t patch = field.index(column, row);
      if (!field.looks_for(patch)) continue;
      PatchOrigin origin = field.nearest[patch];
      origin.x += i;
      origin.y += line;
      if (origin == last_said) continue;  // of one piece with the patch before
      last_said = origin;
      f(origin);
    }
  }
}

/// Energy that vote() and improve() lower in turn: Σ (distance² + floor)^(r / 2).
double robust_energy(const PatchField& field, float floor);

/// Size of the texture without the border that the canvas repeats.
Size texture_size(const PatchField& field);

}  // namespace gramloom
