#pragma once

#include <optional>
#include <string>

#include "core/request.h"

namespace gramloom {

// What the names of maps and their files say: "height", "wall_normal", "Bricks_NormalDX".

/// What a name's words say of the values of a map of so many channels; none where they say nothing.
std::optional<MapKind> kind_of_name(const std::string& name, int channels);

/// Where the green of normals points: down where a word says DirectX, up where one says OpenGL.
std::optional<GreenAxis> green_of_name(const std::string& name);

/// What a map is to a material, told by its name or a usual other word for it: normal, height,
/// roughness, metalness or occlusion; "" for none of these.
std::string material_map(const std::string& map);

}  // namespace gramloom
