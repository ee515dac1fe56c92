#pragma once

#include <string>
#include <string_view>

#include "core/image.h"

namespace gramloom {

/// How help and messages write a size.
inline constexpr const char* size_notation = "SIDE|WIDTHxHEIGHT";

/// The longest side of a result that is made as a whole, as the config has it, and of one that is
/// written row by row.
inline constexpr int longest_side = 65536;
inline constexpr int longest_written_side = 1'000'000;

/// The size that `option` was given: "16384x8192", or one number for a square. Throws ConfigError.
Size size_of(std::string_view option, const std::string& text, int longest = longest_side);

}  // namespace gramloom
