#pragma once

#include "core/image.h"

namespace gramloom {

/// The 4 features of each pixel that patches are compared by: the channels' principal components
/// (all of them up to 4 channels, the rest 0), with mean 0 and total variance 1.
Image patch_features(const Image& image);

/// Half the size (rounded down), each pixel the mean of 2×2, so that pixel (x, y) of the half lies
/// over pixels (2x, 2y) to (2x + 1, 2y + 1).
Image halved(const Image& image);

/// `image`, continued by mirroring to at least `side` pixels in each direction.
Image at_least(const Image& image, int side);

}  // namespace gramloom
