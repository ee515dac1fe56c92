#pragma once

#include <vector>

#include "classic/overlap.h"
#include "core/image.h"

namespace gramloom {

/// The path of least error through a strip of `length` rows and `width` columns, errors[row · width
/// + column]: one column a row, neighbouring rows at most one column apart (Efros & Freeman 2001,
/// section 2.1, by dynamic programming). The leftmost of equal paths' ends is taken.
std::vector<int> minimum_cut(const std::vector<float>& errors, int length, int width);

/// How a fresh patch is joined to what lies there.
struct PatchCut {
  /// Which pixels to take from `fresh`, 1, and which to leave as they are in `old`, 0, row by row:
  /// everything unfilled, and what lies inside the cut along each filled side.
  std::vector<unsigned char> mask;
  /// Σ (old − fresh)² along the cuts.
  double error = 0;
};
PatchCut cut(const Image& old, const Image& fresh, const Sides& sides);

/// The mask as weights of `fresh` in [0, 1], averaged over (2 · radius + 1)² pixels. Unfilled
/// pixels keep 1; beyond a filled side the mask counts as 0.
std::vector<float> feathered(const std::vector<unsigned char>& mask, Size patch, const Sides& sides,
                             int radius);

}  // namespace gramloom
