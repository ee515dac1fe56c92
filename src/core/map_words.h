#pragma once

#include "core/fields.h"
#include "core/request.h"

namespace gramloom {

// The words of configs and records for what a map is.

template <>
inline constexpr auto enum_names<MapKind> = std::to_array<std::string_view>({"colour", "scalar",
                                                                             "normal", "alpha"});
template <>
inline constexpr auto enum_names<GreenAxis> = std::to_array<std::string_view>({"up", "down"});

}  // namespace gramloom
