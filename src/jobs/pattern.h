#pragma once

#include <string_view>

namespace gramloom {

/// Whether the whole text is what the pattern says: * stands for any number of letters, / among
/// them, ? for one letter (of UTF-8), everything else for itself.
bool matches(std::string_view pattern, std::string_view text);

}  // namespace gramloom
