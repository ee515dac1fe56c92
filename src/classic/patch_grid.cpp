#include "classic/patch_grid.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace gramloom {

int PatchAxis::before(int i) const {
  if (i > 0) return starts[to_size(i - 1)] + patch - starts[to_size(i)];
  return wraps && count() > 1 ? starts.back() + patch - length : 0;
}

int PatchAxis::after(int i) const {
  if (i + 1 < count()) return before(i + 1);
  return before(0);
}

PatchAxis cover(int length, int patch, int overlap, bool wraps) {
  patch = std::min(patch, length);
  overlap = std::clamp(overlap, 0, patch - 1);
  for (;; --overlap) {
    const int covered = wraps ? length : length - overlap;
    const int count = std::max((covered + patch - overlap - 1) / (patch - overlap),
                               wraps ? std::min(length, 2) : 1);
    const int step = (covered + count - 1) / count;
    // The overlaps on both sides, each perhaps a pixel more than `overlap`, must fit.
    if (overlap > 0 && count > 1 && step < overlap + 2) continue;
    PatchAxis axis{length, step + overlap, wraps, {}};
    for (int i = 0; i < count; ++i)
      axis.starts.push_back(static_cast<int>(std::int64_t{i} * covered / count));
    return axis;
  }
}

std::vector<std::vector<PatchSlot>> waves(const PatchAxis& x, const PatchAxis& y) {
  const int columns = x.count(), rows = y.count();
  const auto order = [](int column, int row) { return std::tuple(column + 2 * row, row, column); };
  std::vector<PatchSlot> slots;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) slots.push_back({column, row, {}});
  std::ranges::sort(slots, {}, [&](const PatchSlot& s) { return order(s.column, s.row); });

  std::vector<int> wave_of(to_size(columns * rows), -1);  // -1: not laid yet
  std::vector<std::vector<PatchSlot>> result;
  for (PatchSlot& slot : slots) {
    const auto laid = [&](int dx, int dy) {
      int column = slot.column + dx, row = slot.row + dy;
      if (x.wraps) column = (column + columns) % columns;
      if (y.wraps) row = (row + rows) % rows;
      if (column < 0 || row < 0 || column >= columns || row >= rows) return -1;
      return wave_of[to_size(row * columns + column)];
    };
    int wave = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) wave = std::max(wave, laid(dx, dy) + 1);
    if (laid(-1, 0) >= 0) slot.sides.left = x.before(slot.column);
    if (laid(1, 0) >= 0) slot.sides.right = x.after(slot.column);
    if (laid(0, -1) >= 0) slot.sides.top = y.before(slot.row);
    if (laid(0, 1) >= 0) slot.sides.bottom = y.after(slot.row);
    wave_of[to_size(slot.row * columns + slot.column)] = wave;
    if (to_size(wave) == result.size()) result.emplace_back();
    result[to_size(wave)].push_back(slot);
  }
  return result;
}

Image under(const Image& image, int left, int top, Size patch) {
  Image result(patch, image.channels);
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x)
      std::copy_n(image.at((left + x) % image.width, (top + y) % image.height), image.channels,
                  result.at(x, y));
  return result;
}

}  // namespace gramloom
