#pragma once

#include "core/image.h"

namespace gramloom {

/// `image` at another size, each channel by itself: along an axis that shrinks, the mean of the
/// area under each new pixel; along one that grows, cubic interpolation (Keys 1981, a = -0.75),
/// brought back into the channel's own range because cubics overshoot. Throws Error for an empty
/// image or size.
Image resize(const Image& image, Size size);

/// `image` shrunk so that its longer side is `max_side` pixels, the shorter one in proportion (at
/// least 1); an image that fits already comes back as it is. Throws Error when max_side < 1.
Image fit_longer_side(const Image& image, int max_side);

}  // namespace gramloom
