#pragma once

#include "classic/patch_field.h"
#include "core/image.h"

namespace gramloom {

/// For each 8×8 patch of an image of components a like patch of the exemplar: the best of a leaf of
/// a k-d tree over means of 4×4 pixels (He & Sun 2012, "Computing nearest-neighbor fields via
/// propagation-assisted kd-trees"), then passes of PatchMatch (classic/patch_field.h). Approximate,
/// but what is copied is found as such: one lucky patch of a piece tells all others.
PatchField nearest_patches(const Image& image, const Image& exemplar);

}  // namespace gramloom
