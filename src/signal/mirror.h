#pragma once

#include "core/image.h"

namespace gramloom {

/// Where index `i` ≥ 0 of an axis that is continued by mirroring, its last pixel repeated, lies.
int mirrored(int i, int length);

/// `image`, continued by mirroring to at least `side` pixels in each direction.
Image at_least(const Image& image, int side);

}  // namespace gramloom
