#pragma once

#include <string>
#include <vector>

#include "io/field_values.h"
#include "jobs/map_file.h"

namespace gramloom {

/// The maps that --map NAME=FILE names, each time one. Throws ConfigError for another form and for
/// a name that comes twice.
NamedFiles<MapFile> named_maps(const std::vector<std::string>& words);

}  // namespace gramloom
