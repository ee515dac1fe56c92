#pragma once

#include "core/random.h"
#include "core/request.h"

namespace gramloom {

/// Weights of exemplars that are everywhere the same (a channel an exemplar, 1×1), for methods that
/// take each place of one exemplar: of the target's size, 1 for one exemplar of each pixel and 0
/// for the others. Places of one exemplar are islands a few patches wide, and each has exactly its
/// share of the pixels, but for rounding.
Image labels_of_shares(const Target& target, Random random);

}  // namespace gramloom
