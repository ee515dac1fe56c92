#include "classic/patch_material.h"

#include <algorithm>
#include <utility>

#include "classic/patch_levels.h"
#include "core/error.h"
#include "signal/mirror.h"

namespace gramloom {

namespace {

/// A hole is narrow enough for the coarsest level at this width.
constexpr int narrow_hole = 8;
/// Fewer origins than these of an exemplar on a level are too few to choose from.
constexpr int fewest_origins = 64;

/// Where each exemplar begins on a level of this width; nothing for a single one. Those that are
/// too narrow for the level have no part of it.
std::vector<int> parts_of(const United& united, int exemplars, int level, int width) {
  std::vector<int> parts;
  for (int x = 0; exemplars > 1 && x < width && std::ssize(parts) < exemplars; ++x)
    if (united.source(x << level, 0).exemplar >= parts.size()) parts.push_back(x);
  return parts;
}

/// Usable origins of each exemplar on a level.
std::vector<int> count_usable(const PatchSource& source, const United& united, int exemplars,
                              int level) {
  std::vector<int> counts(static_cast<std::size_t>(exemplars));
  const Size size = source.origins();
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      if (source.is_usable({x, y})) ++counts[united.source(x << level, y).exemplar];
  return counts;
}

/// Whether each exemplar that matters on the finest level has origins enough on another.
bool are_enough(const std::vector<int>& finest, const std::vector<int>& counts) {
  double all = 0;
  for (const int count : finest) all += count;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (finest[i] > 0.02 * all && counts[i] < std::min(fewest_origins, finest[i])) return false;
  return true;
}

}  // namespace

PatchMaterial make_material(const PatchmatchParams& params, double structure, const United& united,
                            int exemplars, Size texture) {
  const Exemplar& whole = united.exemplar();
  Exemplar mirrored;  // of a small one
  const bool small = std::min(whole.image.width, whole.image.height) < smallest_side;
  if (small) {
    mirrored.image = at_least(whole.image, smallest_side);
    if (!whole.mask.empty()) mirrored.mask = at_least(whole.mask, smallest_side);
    if (!whole.guide.empty()) mirrored.guide = at_least(whole.guide, smallest_side);
  }
  const Exemplar& exemplar = small ? mirrored : whole;
  PatchMaterial material;
  PatchSource source{
      .features = patch_features(exemplar.image, structure, material.axes),
      .guide = united.guide().empty() ? std::vector<Image>() : guide_planes(exemplar.guide)};
  Image mask = exemplar.mask;
  const Size patch{field_patch, field_patch};
  if (!mask.empty()) source.usable = usable_origins(mask, source.features.size(), patch);
  source.parts = parts_of(united, exemplars, 0, source.features.width);
  const std::vector<int> finest = count_usable(source, united, exemplars, 0);
  if (std::ranges::all_of(finest, [](int n) { return n == 0; }))
    throw Error("patchmatch copies patches of {}×{} pixels: the exemplars' masks leave none whole",
                field_patch, field_patch);
  const int count = level_count(params, exemplar.image.size(), texture);
  material.levels.push_back(std::move(source));
  while (static_cast<int>(material.levels.size()) < count) {
    const PatchSource& finer = material.levels.back();
    PatchSource next{.features = halved(finer.features)};
    const int level = static_cast<int>(material.levels.size());
    next.parts = parts_of(united, exemplars, level, next.features.width);
    for (const Image& plane : finer.guide) next.guide.push_back(halved(plane));
    if (!mask.empty()) {
      mask = halved_mask(mask);
      next.usable = usable_origins(mask, next.features.size(), patch);
      if (!are_enough(finest, count_usable(next, united, exemplars, level))) break;
    }
    material.levels.push_back(std::move(next));
  }
  return material;
}

int levels_for(const PatchMaterial& material, int width) {
  int levels = 1;
  for (; levels < std::ssize(material.levels); ++levels) {
    const Size origins = material.levels[static_cast<std::size_t>(levels - 1)].origins();
    if (width >> (levels - 1) <= narrow_hole && area(origins) <= few_origins) break;
  }
  return levels;
}

double usable_share(const PatchSource& source) {
  if (source.usable.empty()) return 1;
  const auto count = std::ranges::count_if(source.usable, [](auto v) { return v != 0; });
  return static_cast<double>(count) / static_cast<double>(source.usable.size());
}

}  // namespace gramloom
