#include "surface/export/gltf_shapes.h"

#include "core/portable_math.h"

namespace gramloom {

namespace {

// Two triangles for each cell of a grid of vertices, row by row from the top.
void add_grid(ExportMesh& mesh, int columns, int rows) {
  const auto vertex = [&](int column, int row) {
    return static_cast<std::uint16_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      for (const auto& [right, down] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 0}, {0, 1}, {1, 1}})
        mesh.triangles.push_back(vertex(column + right, row + down));
}

// A ball's triangles at the poles have two corners in one place; those are left out.
void drop_flat(ExportMesh& mesh) {
  std::vector<std::uint16_t> kept;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const auto& a = mesh.positions[mesh.triangles[i]];
    const auto& b = mesh.positions[mesh.triangles[i + 1]];
    const auto& c = mesh.positions[mesh.triangles[i + 2]];
    if (a == b || b == c || a == c) continue;
    kept.insert(kept.end(), {mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
  }
  mesh.triangles = std::move(kept);
}

}  // namespace

ExportMesh export_ball() {
  constexpr int columns = 96, rows = 48;
  ExportMesh mesh;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const double around = 2 * portable::pi * (static_cast<double>(column) / columns - 0.5);
      const double down = portable::pi * row / rows;
      // At the poles exactly, and at the seam exactly the same on both sides.
      const double ring = row == 0 || row == rows ? 0 : portable::sin(down);
      const double sine = column == 0 || column == columns ? 0 : portable::sin(around);
      const double cosine = portable::cos(around);
      const std::array<float, 3> point{static_cast<float>(ring * sine),
                                       static_cast<float>(portable::cos(down)),
                                       static_cast<float>(ring * cosine)};
      mesh.positions.push_back(point);
      mesh.normals.push_back(point);
      mesh.tangents.push_back({static_cast<float>(cosine), 0, static_cast<float>(-sine), 1});
      mesh.coordinates.push_back(
          {2 * static_cast<float>(column) / columns, static_cast<float>(row) / rows});
    }
  add_grid(mesh, columns, rows);
  drop_flat(mesh);
  return mesh;
}

ExportMesh export_plane() {
  ExportMesh mesh;
  for (const float v : {0.0f, 1.0f})
    for (const float u : {0.0f, 1.0f}) {
      mesh.positions.push_back({2 * u - 1, 1 - 2 * v, 0});
      mesh.normals.push_back({0, 0, 1});
      mesh.tangents.push_back({1, 0, 0, 1});
      mesh.coordinates.push_back({u, v});
    }
  add_grid(mesh, 1, 1);
  return mesh;
}

}  // namespace gramloom
