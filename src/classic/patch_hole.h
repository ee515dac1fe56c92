#pragma once

#include <vector>

#include "classic/patch_windows.h"
#include "core/image.h"
#include "signal/patch_field.h"

namespace gramloom {

/// A window's pixels on one level.
struct HoleLevel {
  Size size;
  std::vector<PixelState> states;  // row by row
  Image known;                     // features; empty: nothing is known
  std::vector<Image> guide;        // see PatchGuide; none: none
  Image guide_weight;              // squared; empty without a guide
};

/// A window, its pyramid, and what is made of it on the level at hand: of the part about its holes.
struct PatchHole {
  PatchWindow window;
  std::vector<HoleLevel> levels;  // finest first

  int left = 0, top = 0;  // of the part
  Image canvas;
  std::vector<unsigned char> made;  // of the texture's size, row by row
  PatchGuide guide;
  Image guide_weight;
  PatchField field;
};

/// Adds the coarser levels to the finest one.
void make_pyramid(PatchHole& hole);

/// The part about the holes on a level, with its known pixels, guide, and patches that are looked
/// for; these have no origins yet, and pixels that are made no values.
void enter_level(PatchHole& hole, std::size_t level);

/// The same from the next coarser level: each patch comes from where the patch over it comes from,
/// or from `spare` if that cannot be.
void refine(PatchHole& hole, std::size_t level, const PatchSource& source, PatchOrigin spare);

}  // namespace gramloom
