#pragma once

#include <string_view>

#include "surface/mesh.h"

namespace gramloom {

/// The shapes that need no file. Each fits a ball of radius about 1 and stands on its own lowest
/// point. Their own coordinates cover the picture: once around (sphere, cylinder, tube), once on
/// each face (cube, plane, the cylinder's ends), about four times around the teapot.
enum class Shape { sphere, plane, cube, cylinder, teapot, tube };
template <>
inline constexpr auto enum_names<Shape> =
    std::to_array<std::string_view>({"sphere", "plane", "cube", "cylinder", "teapot", "tube"});

/// `longest`: about how long an edge may be; curved shapes have edges as short as they need.
///   sphere    radius 1, coordinates polar (surface/coordinates.h)
///   plane     lies flat, from −1 to 1 in x and z
///   cube      from −0.7 to 0.7
///   cylinder  upright, radius 0.7, 1.4 high, coordinates cylindrical; both ends closed
///   teapot    M. Newell's of 1975, by its 28 bicubic patches with a bottom
///   tube      upright, radius ¼, 2 long, bent in its middle by `bend` degrees (surface/arm.h);
///             open at both ends; v is 1 at the upper one, u ½ on the inside of the bend
Mesh make_shape(Shape shape, float longest, double bend = 0);

/// How often a square picture goes around the shape when it goes along its height once and is not
/// to be stretched.
float widths_around(Shape shape);

/// The points of a grid of columns × rows faces as a mesh: `at` gives the vertex for (s, t) in
/// [0, 1]², with t upwards as seen from outside.
struct Vertex {
  Vec3 position, normal;
  Vec2 coordinates;
};
template <class At>
void add_grid(Mesh& mesh, int columns, int rows, At&& at) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      const Vertex vertex = at(static_cast<float>(x) / static_cast<float>(columns),
                               static_cast<float>(y) / static_cast<float>(rows));
      mesh.positions.push_back(vertex.position);
      mesh.normals.push_back(vertex.normal);
      mesh.coordinates.push_back(vertex.coordinates);
    }
  const auto row = static_cast<std::uint32_t>(columns + 1);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = mesh.positions;
    if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh.triangles.push_back({a, b, c});
  };
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(rows); ++y)
    for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(columns); ++x) {
      const std::uint32_t corner = first + y * row + x;
      add(corner, corner + 1, corner + row + 1);
      add(corner, corner + row + 1, corner + row);
    }
}

/// The teapot's patches in grids of n × n faces, in its own units: the bottom at height 0.
Mesh teapot(int n);

}  // namespace gramloom
