#pragma once

#include "classic/patch_field.h"
#include "core/image.h"
#include "metrics/patch_tree.h"

namespace gramloom {

/// For each 8×8 patch of an image of components a like patch of the exemplar: the best of a leaf of
/// its tree, then passes of PatchMatch (classic/patch_field.h). Approximate,
/// but what is copied is found as such: one lucky patch of a piece tells all others.
/// `tree` is the exemplar's.
PatchField nearest_patches(const Image& image, const Image& exemplar, const PatchTree& tree);

}  // namespace gramloom
