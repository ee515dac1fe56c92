#include "learnt/level_axis.h"

#include <algorithm>

namespace gramloom {

std::vector<LevelAxis> level_axes(int length, bool tiles, int levels) {
  std::vector<LevelAxis> axes(static_cast<std::size_t>(levels));
  if (!tiles) return axes;
  std::int64_t own = length;
  for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
    *axis = {own, std::max<std::int64_t>(1, (own + 1) / 2)};
    own = axis->coarser;
  }
  return axes;
}

// In whole numbers, so that what wraps is the same to the last bit: pixel x, of centre x + 1/2, is
// at (x + 1/2) · coarser / length − 1/2.
Upsampling upsampling(const LevelAxis& axis, std::int64_t first, int count) {
  const std::int64_t fine = axis.length == 0 ? 2 : axis.length;
  const std::int64_t coarse = axis.length == 0 ? 1 : axis.coarser;
  Upsampling result;
  for (std::int64_t x = first; x < first + count; ++x) {
    const std::int64_t above = (2 * x + 1) * coarse - fine, below = 2 * fine;
    const std::int64_t rest = ((above % below) + below) % below;
    result.from.push_back((above - rest) / below);
    result.weights.push_back(static_cast<float>(rest) / static_cast<float>(below));
  }
  return result;
}

int coarser_count(const LevelAxis& axis, int count) {
  const std::int64_t fine = axis.length == 0 ? 2 : axis.length;
  const std::int64_t coarse = axis.length == 0 ? 1 : axis.coarser;
  return static_cast<int>((count * coarse + fine - 1) / fine) + 2;
}

}  // namespace gramloom
