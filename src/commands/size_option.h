#pragma once

#include <string>
#include <string_view>

#include "core/image.h"

namespace gramloom {

/// How help and messages write a size.
inline constexpr const char* size_notation = "SIDE|WIDTHxHEIGHT";

/// Of a result that is written row by row, so that it need not fit into memory.
inline constexpr int longest_written_side = 1'000'000;

/// The size that `option` was given: "16384x8192", or one number for a square. Throws ConfigError.
Size size_of(std::string_view option, const std::string& text, int longest = longest_side);

}  // namespace gramloom
