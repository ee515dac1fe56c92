#pragma once

#include "io/image_file.h"

namespace gramloom {

/// The channels but for alpha: a last one that is called "A".
Image without_alpha(ImageFile picture);

}  // namespace gramloom
