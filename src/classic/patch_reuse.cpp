#include "classic/patch_reuse.h"

#include <algorithm>
#include <cstdlib>

#include "core/simd.h"

namespace gramloom {

namespace {

float shared_part(int offset, int side) {
  return static_cast<float>(side - std::abs(offset)) / static_cast<float>(side);
}

GRAMLOOM_SIMD void add_weighted(const float* __restrict from, float weight, float* __restrict to,
                                std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to[i] += weight * from[i];
}

}  // namespace

PatchReuse::PatchReuse(Size positions, Size patch)
    : positions_(positions),
      patch_(patch),
      use_(static_cast<std::size_t>(positions.width) * static_cast<std::size_t>(positions.height)) {
}

void PatchReuse::add(PatchOrigin laid) {
  const int left = std::max(0, laid.x - patch_.width + 1);
  const int right = std::min(positions_.width, laid.x + patch_.width);
  const int top = std::max(0, laid.y - patch_.height + 1);
  const int bottom = std::min(positions_.height, laid.y + patch_.height);
  for (int y = top; y < bottom; ++y) {
    float* row = use_.data() + static_cast<std::ptrdiff_t>(y) * positions_.width;
    for (int x = left; x < right; ++x)
      row[x] += shared_part(x - laid.x, patch_.width) * shared_part(y - laid.y, patch_.height);
  }
}

void PatchReuse::add_to(std::vector<float>& errors, float weight) const {
  add_weighted(use_.data(), weight, errors.data(), errors.size());
}

}  // namespace gramloom
