#pragma once

#include "classic/patchmatch.h"
#include "signal/patch_origin.h"

namespace gramloom {

/// Sides below this are too short for patches to find their like in.
inline constexpr int smallest_side = 2 * field_patch;
inline constexpr int more_iterations = 12;  // on each coarser level

/// Squared distance of patches that are as good as equal: 1e-4 of the exemplar's variance a pixel.
inline constexpr float noise_floor = 1e-4f * field_patch * field_patch;
/// The same for a first vote, whose patches' distances are not known yet: all weights are equal.
inline constexpr float equal_weights = 1;

/// How many levels fit.
int level_count(const PatchmatchParams& params, Size exemplar, Size texture);

}  // namespace gramloom
