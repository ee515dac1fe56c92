#include "classic/quilt_guide.h"

#include <algorithm>
#include <utility>

#include "classic/patch_grid.h"

namespace gramloom {

QuiltGuide::QuiltGuide(const Image& exemplar, Image canvas, Size patch)
    : canvas_(std::move(canvas)),
      patch_{std::min(std::max(1, patch.width / factor), exemplar.width),
             std::min(std::max(1, patch.height / factor), exemplar.height)},
      errors_(exemplar, patch_) {}

void QuiltGuide::add_to(std::vector<float>& errors, Size positions, PatchOrigin place, Size size,
                        float weight) const {
  const Image wanted = under(canvas_, place.x * canvas_.width / size.width,
                             place.y * canvas_.height / size.height, patch_);
  std::vector<float> coarse;
  errors_.compute(wanted, {patch_.width, 0, 0, 0}, coarse);
  const Size origins = errors_.positions();
  for (int v = 0; v < positions.height; ++v) {
    const float* from =
        coarse.data() + to_size(std::min(v / factor, origins.height - 1)) * to_size(origins.width);
    float* to = errors.data() + to_size(v) * to_size(positions.width);
    for (int u = 0; u < positions.width; ++u)
      to[u] += factor * factor * weight * from[std::min(u / factor, origins.width - 1)];
  }
}

}  // namespace gramloom
