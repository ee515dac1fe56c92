#pragma once

#include <span>

#include "surface/mesh.h"

namespace gramloom {

/// The positions of a mesh's vertices moved along their normals by amplitude · height, a height a
/// vertex. Vertices at the same place move together, along the mean of their normals by the mean of
/// their heights, so that no seam opens; at edges as much further as keeps the faces flat.
std::vector<Vec3> displaced(const Mesh& mesh, std::span<const float> heights, float amplitude);

}  // namespace gramloom
