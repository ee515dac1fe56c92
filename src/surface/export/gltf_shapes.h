#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace gramloom {

/// A mesh of triangles, counterclockwise from outside, with what glTF wants of each vertex.
struct ExportMesh {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 4>> tangents;     // to the right in the picture; w = 1
  std::vector<std::array<float, 2>> coordinates;  // (0, 0) is the picture's upper left corner
  std::vector<std::uint16_t> triangles;
};

/// Radius 1, poles on the y axis, the picture twice around.
ExportMesh export_ball();
/// From −1 to 1 in x and y, facing z, the picture once.
ExportMesh export_plane();

}  // namespace gramloom
