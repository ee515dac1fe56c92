#include "surface/displacement.h"

namespace gramloom {

namespace {

constexpr float sharpest_edge = 2;  // how much further than a face's height an edge moves

}  // namespace

std::vector<Vec3> displaced(const Mesh& mesh, std::span<const float> heights, float amplitude) {
  const std::vector<std::uint32_t> place = same_places(mesh);
  const std::size_t count = mesh.positions.size();
  std::vector<Vec3> normals(count);
  std::vector<float> sums(count), members(count);
  for (std::size_t i = 0; i < count; ++i) {
    normals[place[i]] += mesh.normals[i];
    sums[place[i]] += heights[i];
    members[place[i]] += 1;
  }
  std::vector<Vec3> moved(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t p = place[i];
    // At an edge as far as takes the faces on both sides outwards by the height, if not too far.
    const Vec3& n = normals[p];
    const float reach = std::min(members[p] / std::max(length(n), 1e-6f), sharpest_edge);
    moved[i] = mesh.positions[p] + normalised(n) * (amplitude * reach * sums[p] / members[p]);
  }
  return moved;
}

}  // namespace gramloom
