#pragma once

#include <vector>

#include "core/image.h"
#include "signal/patch_origin.h"
#include "signal/sparse_plane.h"

namespace gramloom {

struct PatchField;

/// What it costs a patch at (x, y) to come from an origin, besides its distance.
struct PatchPenalty {
  Size field;
  Size origins;
  std::vector<float> of_origin;  // row by row
  SparsePlane of_shift;          // see shift()

  PatchPenalty(Size field_, Size origins_);

  /// Where the shift origin − (x, y) lies among all. Patches of one shift are one piece of the
  /// exemplar.
  PatchOrigin shift(int x, int y, PatchOrigin origin) const {
    return {origin.x - x + field.width - 1, origin.y - y + field.height - 1};
  }
  Size shifts() const {
    return {field.width + origins.width - 1, field.height + origins.height - 1};
  }
  std::size_t index(PatchOrigin origin) const {
    return static_cast<std::size_t>(origin.y) * static_cast<std::size_t>(origins.width) +
           static_cast<std::size_t>(origin.x);
  }
};

/// How often each patch of the exemplar and those less than half a patch away are used, relative
/// to equal use of all.
std::vector<float> usage(const PatchField& field, Size origins);

/// Moves the penalties half the way to what the field calls for:
/// - of_origin = uniformity · patch's values · (usage − 1) where usage > 1 (Kaspar et al. 2015,
///   section 5.1, whose penalty is usage itself);
/// - of_shift = patch's values / 2 · (count / limit − 1), at most 4 of them, where the `count` of
///   patches with one shift exceeds limit = largest_copy · number of origins (ours: a texture made
///   of whole copies of the exemplar would use it uniformly).
/// `usable`: part of the origins that may be used, of which usage and limit are.
void update(PatchPenalty& penalty, const PatchField& field, double uniformity, double largest_copy,
            double usable = 1);

}  // namespace gramloom
