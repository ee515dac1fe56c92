#include "classic/quilt_task.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "classic/patch_features.h"
#include "core/error.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// Of patches from anything smaller there would be as many as pixels.
constexpr int smallest_usable = 6;

Image quarter(const Image& image) { return image.empty() ? Image{} : halved(halved(image)); }
Image quarter_mask(const Image& mask) {
  return mask.empty() ? Image{} : halved_mask(halved_mask(mask));
}
Image inverse(Image mask) {
  for (float& m : mask.pixels) m = m > 0.5f ? 0.0f : 1.0f;
  return mask;
}

Source first_usable(const Exemplar& exemplar) {
  if (exemplar.mask.empty()) return {};
  const auto first = std::ranges::find_if(exemplar.mask.pixels, [](float m) { return m > 0.5f; });
  const auto index = static_cast<int>(first - exemplar.mask.pixels.begin());
  return {index % exemplar.mask.width, index / exemplar.mask.width};
}

}  // namespace

QuarterTask::QuarterTask(const QuiltTask& task)
    : exemplar{quarter(task.exemplar.image),
               {},
               quarter_mask(task.exemplar.mask),
               quarter(task.exemplar.guide)},
      known(quarter(task.known)),
      mask(inverse(quarter_mask(inverse(task.mask)))),
      guide(quarter(task.guide)),
      weight(task.weight.size() == task.size ? quarter(task.weight) : task.weight),
      size{task.size.width / QuiltGuide::factor, task.size.height / QuiltGuide::factor},
      tile(task.tile),
      quota(task.quota) {}

Quilt make_quilt(const QuiltTask& task, const QuiltGrid& grid, const QuiltRules& rules,
                 const QuiltGuide* guide, Random random, const QuiltReport& report) {
  std::optional<QuiltDirection> direction;
  if (task.directed()) direction.emplace(task.exemplar, task.guide, task.weight, grid.patch());
  const QuiltMaterial material{task.exemplar.image, direction ? &*direction : nullptr, guide,
                               task.quota, task.quota_factor};
  if (task.known.empty()) return lay_quilt(material, grid.x, grid.y, rules, random, report);
  Quilt quilt{task.known, SourceMap(task.size)};
  std::ranges::fill(quilt.source.pixels, first_usable(task.exemplar));
  std::vector<Ground> ground(task.mask.pixels.size());
  std::ranges::transform(task.mask.pixels, ground.begin(),
                         [](float m) { return m > 0.5f ? Ground::bare : Ground::firm; });
  fill_quilt(quilt, std::move(ground), material, grid.x, grid.y, rules, random, report);
  return quilt;
}

Size usable_size(const std::vector<Exemplar>& exemplars) {
  if (exemplars.size() == 1 && exemplars.front().mask.empty())
    return exemplars.front().image.size();
  int side = std::numeric_limits<int>::max(), smallest = side;
  for (const Exemplar& exemplar : exemplars) {
    smallest = std::min({smallest, exemplar.image.width, exemplar.image.height});
    side = std::min({side, exemplar.image.width, exemplar.image.height,
                     exemplar.mask.empty() ? side : largest_usable_square(exemplar.mask)});
  }
  if (side < std::min(smallest, smallest_usable))
    throw Error("quilting needs usable pieces of {0}×{0} pixels: an exemplar's mask leaves {1}×{1}",
                smallest_usable, side);
  return {side, side};
}

}  // namespace gramloom
