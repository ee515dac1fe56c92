#pragma once

#include <vector>

#include "classic/overlap.h"
#include "core/image.h"

namespace gramloom {

/// How patches cover one axis of a texture.
struct PatchAxis {
  int length = 0;           // of the texture
  int patch = 0;            // side of a patch
  bool wraps = false;       // the last patch overlaps the first
  std::vector<int> starts;  // first pixel of each patch

  int count() const { return static_cast<int>(starts.size()); }
  /// Overlap of patch `i` with the one before it and with the one after it; 0 at an open end.
  int before(int i) const;
  int after(int i) const;
};

/// Evenly spaced patches that cover the axis: overlaps are `overlap` or one more pixel, patches at
/// most `patch` long. Both shrink where the axis is too short for them.
PatchAxis cover(int length, int patch, int overlap, bool wraps);

/// One patch of a grid, and which part of it is filled when its turn comes.
struct PatchSlot {
  int column = 0;
  int row = 0;
  Sides sides;
};

/// The patches of a grid in waves: those of a wave neither overlap nor neighbour each other, so
/// they can be laid at the same time.
std::vector<std::vector<PatchSlot>> waves(const PatchAxis& x, const PatchAxis& y);

/// The part of `image` under a patch at (left, top), which may reach around its edges.
Image under(const Image& image, int left, int top, Size patch);

}  // namespace gramloom
