#include "classic/quilt_direction.h"

#include <algorithm>

#include "classic/patch_grid.h"
#include "core/error.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// Above every sum of squares; sums with it stay finite.
constexpr float unusable = 1e37f;

}  // namespace

QuiltDirection::QuiltDirection(const Exemplar& exemplar, const Image& guide, const Image& weight,
                               Size patch)
    : guide_(guide), weight_(weight), patch_(patch) {
  if (!exemplar.mask.empty()) {
    usable_ = usable_origins(exemplar.mask, exemplar.image.size(), patch);
    if (std::ranges::find(usable_, 1) == usable_.end())
      throw Error("quilting needs usable pieces of {}×{} pixels: the exemplar's mask leaves none",
                  patch.width, patch.height);
  }
  if (!guide.empty()) guide_errors_.emplace(exemplar.guide, patch);
}

void QuiltDirection::add_to(std::vector<float>& errors, PatchOrigin place, float unit,
                            const std::vector<float>& made) const {
  if (guided()) {
    const Image wanted = under(guide_, place.x, place.y, patch_);
    std::vector<float> weights(made);
    if (weights.empty()) weights.assign(to_size(patch_.width) * to_size(patch_.height), 1.0f);
    float count = 0;
    for (const float w : weights) count += w;
    if (!weight_.empty())
      for (int y = 0; y < patch_.height; ++y)
        for (int x = 0; x < patch_.width; ++x) {
          const float w =
              *map_at(weight_, (place.x + x) % guide_.width, (place.y + y) % guide_.height);
          weights[to_size(y) * to_size(patch_.width) + to_size(x)] *= w * w;
        }
    if (count > 0) guide_errors_->add_to(errors, wanted, weights, unit / count);
  }
  for (std::size_t i = 0; i < usable_.size(); ++i)
    if (usable_[i] == 0) errors[i] = unusable;
}

int largest_usable_square(const Image& mask) {
  // The largest square whose lower right pixel this is, row by row.
  std::vector<int> above(to_size(mask.width) + 1), here(above);
  int largest = 0;
  for (int y = 0; y < mask.height; ++y, above.swap(here))
    for (std::size_t x = 1; x < here.size(); ++x) {
      const bool usable = *mask.at(static_cast<int>(x) - 1, y) > 0.5f;
      here[x] = usable ? 1 + std::min({above[x - 1], above[x], here[x - 1]}) : 0;
      largest = std::max(largest, here[x]);
    }
  return largest;
}

}  // namespace gramloom
