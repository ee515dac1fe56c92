#pragma once

#include <string>

#include "core/image.h"
#include "io/json_text.h"

namespace gramloom {

/// The map that a job's file is of its texture: "height" of "seed1_height.png" and the job
/// "exemplar/method/seed1"; "" for the texture itself.
std::string map_of_file(const std::string& job, const std::string& file);

/// What a map is to a material, told by its name or a usual other word for it: normal, height,
/// roughness, metalness or occlusion; "" for none of these.
std::string material_map(const std::string& map);

/// The edges of a job's texture that meet, by its settings; none where they do not say.
Tile tile_of(const Json& settings);

}  // namespace gramloom
