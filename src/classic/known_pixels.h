#pragma once

#include "core/request.h"

namespace gramloom {

/// Gives the pixels of the target that are not to be made the values that are known of them.
void keep_known(Image& image, const Target& target);

}  // namespace gramloom
