#pragma once

#include <string_view>

namespace gramloom {

/// Of the build that this library is of. Two builds with one stamp fit each other: modules and
/// whatever else is built apart have been compiled with the same headers (build_stamp.cmake).
std::string_view build_stamp();

}  // namespace gramloom
