#pragma once

#include <vector>

#include "core/image.h"
#include "core/random.h"
#include "signal/patch_penalty.h"
#include "signal/patch_source.h"

namespace gramloom {

/// For each patch of a canvas the like patch of an exemplar. The canvas has field_patch − 1 more
/// pixels than the field in each direction: on an axis that tiles they repeat the first ones.
struct PatchField {
  Size size;
  Tile tile = Tile::none;
  std::vector<SmallOrigin> nearest;  // row by row
  std::vector<float> distance;       // squared, summed over the patch's values
  /// How much each patch's vote counts; 0: it is not looked for and has none. Empty: all are alike.
  std::vector<float> confidence = {};

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(x);
  }
  bool looks_for(std::size_t patch) const { return confidence.empty() || confidence[patch] > 0; }
};

/// Throws Error for an exemplar of more than 65,536 pixels on a side, which a field cannot name.
void check_origins(Size exemplar);

/// All patches at origin (0, 0), at distance 0.
PatchField blank_field(Size size, Tile tile);
/// Every patch at a random one of the origins.
PatchField random_field(Size size, Tile tile, Size origins, Random random);

/// One pass of PatchMatch (Barnes, Shechtman, Finkelstein, Goldman 2009, "PatchMatch: a randomized
/// correspondence algorithm for structural image editing"): every patch tries what its neighbours
/// suggest, down and to the right in even passes, up and to the left in odd ones, then `tries`
/// random origins from ever smaller windows about the best so far. The cost is the squared distance
/// plus the penalty; it never rises. Bands of rows are scanned at the same time, each seeing
/// the others as they were before the pass (a departure from the paper, which scans the whole
/// field in one order).
void improve(PatchField& field, const Image& canvas, const Image& exemplar,
             const PatchPenalty& penalty, int pass, int tries, Random random);

/// The least-cost origin of every patch, by trying all.
void search_all(PatchField& field, const Image& canvas, const Image& exemplar,
                const PatchPenalty& penalty);

/// The same two of patches that are asked for more: only usable origins are tried, by the patches
/// that are looked for; distances are those of pictures and guides together. No penalty: null.
void improve(PatchField& field, const Image& canvas, const PatchGuide& guide,
             const PatchSource& source, const PatchPenalty* penalty, int pass, int tries,
             Random random);
void search_all(PatchField& field, const Image& canvas, const PatchGuide& guide,
                const PatchSource& source, const PatchPenalty* penalty);

}  // namespace gramloom
