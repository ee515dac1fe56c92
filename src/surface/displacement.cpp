#include "surface/displacement.h"

namespace gramloom {

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
    moved[i] = mesh.positions[p] + normalised(normals[p]) * (amplitude * sums[p] / members[p]);
  }
  return moved;
}

}  // namespace gramloom
