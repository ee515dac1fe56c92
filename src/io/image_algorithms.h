#pragma once

#include "core/image.h"

namespace gramloom {

// What OpenImageIO's ImageBufAlgo does with pictures in memory.

/// How two pictures differ.
struct PixelDifference {
  double share = 0;  // of the pixels, those with a channel that differs by more than the tolerance
  double largest = 0;  // of any channel
};

/// Of two pictures of the same size and channels. Throws Error when they are not.
PixelDifference difference(const Image& a, const Image& b, double tolerance);

}  // namespace gramloom
