#pragma once

#include <filesystem>

#include "surface/mesh.h"

namespace gramloom {

/// The mesh of a Wavefront OBJ file, all objects in one, faces in triangles, fitted into the ball
/// of radius 1, by tinyobjloader (from the module). Its normals are the file's; faces without any
/// get smooth ones, weighted by angle. Throws Error with the path for a file that cannot be read,
/// and what check_mesh() refuses.
Mesh read_mesh(const std::filesystem::path& path);

}  // namespace gramloom
