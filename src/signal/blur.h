#pragma once

#include "core/image.h"

namespace gramloom {

/// `image` weighted by a Gaussian of that standard deviation, in pixels, cut off after four of
/// them. On an axis that tiles it goes on across the edge, on others it is mirrored there. Throws
/// Error for an empty image.
Image blurred(const Image& image, double deviation, Tile wraps);

}  // namespace gramloom
