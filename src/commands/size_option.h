#pragma once

#include <string>
#include <string_view>

#include "core/image.h"

namespace gramloom {

/// The size that `option` was given: "16384x8192", or one number for a square. Throws ConfigError.
Size size_of(std::string_view option, const std::string& text);

}  // namespace gramloom
