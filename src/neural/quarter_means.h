#pragma once

#include "core/image.h"

namespace gramloom::neural {

/// What of a guide lies under the patches of a picture: for each pixel the means over the four
/// quarters of the patch of which it is the upper left one, quarter by quarter; patches go on
/// across all edges. Small detail of a guide has no say, but where in a patch a border runs has.
Image quarter_means(const Image& guide, int side);

/// The sums over the patches' pixels of an image of one channel.
Image patch_sums(const Image& image, int side);

}  // namespace gramloom::neural
