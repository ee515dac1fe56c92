#pragma once

#include <filesystem>
#include <vector>

#include "io/field_values.h"
#include "jobs/map_file.h"

namespace gramloom {

/// The pictures in a folder, in the order of their names, by their extensions. Maps of another one
/// there ("wall_height.png" beside "wall.png" or "wall_colour.png") are left out, and so are
/// folders and hidden files. Throws Error, one line with the path, for what is no folder or cannot
/// be read.
std::vector<std::filesystem::path> pictures_in(const std::filesystem::path& folder);

/// The pictures beside `picture` that are maps of it by the same rule, called by the words in their
/// names: "height" of "wall_height.png". Of two of one name, the first counts.
NamedFiles<MapFile> maps_beside(const std::filesystem::path& picture);

}  // namespace gramloom
