#pragma once

#include <vector>

#include "classic/patch_hole.h"
#include "signal/patch_source.h"

namespace gramloom {

/// Each made pixel's origin in the source (others are at (0, 0)), row by row: of what the patches
/// over it say, and of what its neighbours' pieces would go on with, the one whose cost is least:
/// - its squared difference from the votes' mean, and that of their guides;
/// - for each of its four neighbours, how much that differs from the origin's own neighbour: cuts
///   between pieces, and between pieces and known pixels, go where they do not show (Kwatra et al.
///   2003, "Graphcut textures", section 3; here by sweeps over all pixels instead of cuts).
std::vector<SmallOrigin> choose_pixels(const PatchHole& hole, const PatchSource& source);

}  // namespace gramloom
