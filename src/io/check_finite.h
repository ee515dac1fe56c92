#pragma once

#include "core/image.h"

namespace gramloom {

/// Throws Error with the place of the first NaN or infinite value.
void check_finite(const Image& image);

}  // namespace gramloom
