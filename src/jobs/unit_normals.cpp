#include "jobs/unit_normals.h"

#include <algorithm>

#include "core/threads.h"
#include "surface/normal_map.h"

namespace gramloom {

namespace {

// Whether the texture has, at that pixel and in those channels, what its source has.
bool is_copy(const Texture& texture, const std::vector<Exemplar>& exemplars, int x, int y,
             const Layer& layer) {
  if (texture.source.empty()) return false;
  const Source from = *texture.source.at(x, y);
  const float* there =
      exemplars[from.exemplar].image.at(static_cast<int>(from.x), static_cast<int>(from.y)) +
      layer.first;
  return std::equal(there, there + layer.count, texture.image.at(x, y) + layer.first);
}

}  // namespace

void keep_normals_unit(Texture& texture, const std::vector<Exemplar>& exemplars) {
  if (exemplars.empty()) return;
  for (const Layer& layer : exemplars.front().layers) {
    if (layer.kind != MapKind::normal) continue;
    parallel_for(texture.image.height, 16, [&](std::int64_t begin, std::int64_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
        for (int x = 0; x < texture.image.width; ++x)
          if (!is_copy(texture, exemplars, x, y, layer))
            make_unit(texture.image.at(x, y) + layer.first);
    });
  }
}

}  // namespace gramloom
