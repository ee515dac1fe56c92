#pragma once

#include <string_view>

namespace gramloom {

/// Command lines that show what `command` is for, one a line; "" for a command that has none. They
/// stand at the end of its --help, and in the manual.
std::string_view examples_of(std::string_view command);

}  // namespace gramloom
