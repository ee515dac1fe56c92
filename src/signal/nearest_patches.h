#pragma once

#include "core/image.h"
#include "signal/patch_field.h"
#include "signal/patch_tree.h"

namespace gramloom {

/// For each 8×8 patch of an image of 4 features a like patch of the exemplar: the best of a leaf of
/// its tree, then passes of PatchMatch (signal/patch_field.h). Approximate,
/// but what is copied is found as such: one lucky patch of a piece tells all others.
/// `tree` is the exemplar's.
PatchField nearest_patches(const Image& image, const Image& exemplar, const PatchTree& tree);

}  // namespace gramloom
