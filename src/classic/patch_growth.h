#pragma once

#include <vector>

#include "classic/patch_hole.h"
#include "classic/patch_places.h"
#include "core/random.h"

namespace gramloom {

/// Makes a hole without known pixels as a quilt (quilting.h), which keeps rows and grids straight:
/// sets its canvas and the origins of its patches. false: the source is too small for its patches.
bool quilt(PatchHole& hole, std::size_t level, const PatchSource& source, Random random);

/// Makes the pixels of a hole by growing from its border inward, as Criminisi, Pérez, Toyama 2004
/// ("Region filling and object removal by exemplar-based image inpainting"): the patch whose known
/// pixels are most and differ most comes next, and the rest of it is copied from where those are
/// alike. Departures: pixels about the patch are compared too, though they count less, as on the
/// coarsest level they show the structures that a patch is too small for; their data term, the
/// isophote across the border, is the deviation of the patch's known pixels; of places within
/// `tolerance` of the best one is drawn. Sets the canvas and the origins of patches: where the
/// patch's middle was copied from. Without known pixels it grows from a patch in the middle.
void grow(PatchHole& hole, const GrowthPlaces& places, float tolerance, Random random);

}  // namespace gramloom
