#pragma once

#include <vector>

#include "classic/patch_hole.h"
#include "core/random.h"

namespace gramloom {

/// Up to `most` of the usable origins, evenly spread over all.
std::vector<PatchOrigin> some_origins(const PatchSource& source, std::size_t most);

/// Makes the pixels of a hole by growing from its border inward, as Criminisi, Pérez, Toyama 2004
/// ("Region filling and object removal by exemplar-based image inpainting"): the patch whose known
/// pixels are most and differ most comes next, and the rest of it is copied from where those are
/// alike. Departures: their data term, the isophote across the border, is the deviation of the
/// patch's known pixels; of places within `tolerance` of the best one is drawn. Sets the canvas and
/// the origins of patches: where the patch's middle was copied from. Without known pixels it grows
/// from a patch in the middle.
void grow(PatchHole& hole, const PatchSource& source, const std::vector<PatchOrigin>& origins,
          float tolerance, Random random);

}  // namespace gramloom
