#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/fields.h"
#include "surface/vec3.h"

namespace gramloom {

/// Triangles with shared vertices: counter-clockwise as seen from outside. Vertices at the same
/// place may differ in their normals (an edge) or texture coordinates (a seam).
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;      // unit; one a position
  std::vector<Vec2> coordinates;  // likewise; none where the mesh has no texture coordinates
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The most triangles that a mesh may have.
inline constexpr std::size_t most_triangles = 4'000'000;

/// Throws Error, which begins with `name`, for a mesh without triangles, with more than
/// most_triangles, with a value that is not finite, or with a triangle of no area.
void check_mesh(const Mesh& mesh, const std::string& name);

/// How the normals of a mesh's vertices are made of those of the faces around them.
enum class NormalWeights { area, angle };

/// The normal of each vertex: the mean of those of the faces at its place, whatever their texture
/// coordinates, weighted by the faces' areas or by their angles there (Thürmer, Wüthrich 1998,
/// "Computing vertex normals from polygonal facets").
std::vector<Vec3> smooth_normals(const Mesh& mesh, NormalWeights weights);

/// The mesh with corners of its own for each triangle, whose normals are the triangle's.
Mesh faceted(const Mesh& mesh);

/// For each vertex the first one at the same place, within `distance`. Only vertices at the border
/// of a sheet of triangles are compared: within one, all triangles share the same vertex.
std::vector<std::uint32_t> same_places(const Mesh& mesh, float distance = 1e-5f);

/// The mesh moved and scaled to fit the ball of radius 1 around the origin.
Mesh fitted(Mesh mesh);

/// Each edge longer than `longest` halved, until there is none: new corners lie on the old
/// triangles, their normals and coordinates are the mean of the edge's. Throws Error when there
/// would be more than most_triangles.
Mesh subdivided(Mesh mesh, float longest);

}  // namespace gramloom
