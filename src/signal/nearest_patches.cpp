#include "signal/nearest_patches.h"

#include <limits>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom {

namespace {

constexpr int passes = 4;
constexpr int tries = 4;

constexpr int lanes = 8;
typedef float Lanes __attribute__((vector_size(lanes * sizeof(float)), aligned(4), may_alias));

GRAMLOOM_INLINE float distance_of_patches(const Image& a, int ax, int ay, const Image& b, int bx,
                                          int by) {
  Lanes sums = {};
  for (int y = 0; y < field_patch; ++y) {
    const Lanes* u = reinterpret_cast<const Lanes*>(a.at(ax, ay + y));
    const Lanes* v = reinterpret_cast<const Lanes*>(b.at(bx, by + y));
    for (int k = 0; k < field_patch * field_features / lanes; ++k) {
      const Lanes d = u[k] - v[k];
      sums += d * d;
    }
  }
  return ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

/// The best of each patch's leaf, for one row.
GRAMLOOM_SIMD void search_leaves(PatchField& field, int y, const Image& image,
                                 const Image& exemplar, const Image& means, const PatchTree& tree) {
  for (int x = 0; x < field.size.width; ++x) {
    const std::int64_t leaf = tree.leaf(means, x, y);
    const std::int64_t end = tree.first_of(leaf + 1);
    float best = std::numeric_limits<float>::infinity();
    for (std::int64_t i = tree.first_of(leaf); i < end; ++i) {
      const PatchOrigin o = tree.origin(i);
      const float distance = distance_of_patches(image, x, y, exemplar, o.x, o.y);
      if (distance >= best) continue;
      best = distance;
      field.nearest[field.index(x, y)] = o;
    }
  }
}

}  // namespace

PatchField nearest_patches(const Image& image, const Image& exemplar, const PatchTree& tree) {
  const Size size = patch_origins(image.size());
  PatchField field = blank_field(size, Tile::none);
  {
    const Image means = box_means(image);
    parallel_for(size.height, 4, [&](std::int64_t begin, std::int64_t end) {
      for (auto y = static_cast<int>(begin); y < end; ++y)
        search_leaves(field, y, image, exemplar, means, tree);
    });
  }
  const PatchPenalty none(size, patch_origins(exemplar.size()));
  for (int pass = 0; pass < passes; ++pass)
    improve(field, image, exemplar, none, pass, tries, Random(0, static_cast<std::uint64_t>(pass)));
  return field;
}

}  // namespace gramloom
