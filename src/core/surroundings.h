#pragma once

#include "core/request.h"

namespace gramloom {

/// Pixels [left, right) × [top, bottom).
struct Box {
  int left = 0, top = 0, right = 0, bottom = 0;

  Size size() const { return {right - left, bottom - top}; }
  friend bool operator==(const Box&, const Box&) = default;
};

/// About all pixels of a mask that are 1; empty where there are none.
Box box_of(const Image& mask);

/// A box of holes with what a fill looks at around them: on each side 128 pixels, or as much as the
/// box is large, as far as the picture goes.
Box with_surroundings(const Box& holes, Size picture);

/// Whether at least a quarter of a box may be used, by such a mask (empty: all may): of less a fill
/// cannot be made.
bool has_enough(const Image& mask, const Box& box);

/// Whether the exemplar is the picture that is filled: every known pixel is its own at the same
/// place, as far as that may be used. Of rows, each `every`th is looked at.
bool is_filled(const Exemplar& exemplar, const Target& target, int every = 1);

}  // namespace gramloom
