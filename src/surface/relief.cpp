#include "surface/relief.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/threads.h"

namespace gramloom {

namespace {

constexpr std::int64_t rows_at_once = 32;

// What lies one step beyond the end of a row or column that does not wrap.
float beyond(float last, float before_last) { return 2 * last - before_last; }

// Row y, which may be one beyond an edge, into to[-1] to to[width].
void copy_ground(const Image& height, int y, float strength, Tile wraps, float* to) {
  const int width = height.width, last = height.height - 1;
  const bool outside = y < 0 || y > last;
  if (outside && tiles_y(wraps)) {
    copy_ground(height, y < 0 ? last : 0, strength, wraps, to);
    return;
  }
  const int edge = std::clamp(y, 0, last);
  const float* row = height.at(0, edge);
  for (int x = 0; x < width; ++x) to[x] = strength * row[x];
  if (outside && last > 0) {
    const float* inner = height.at(0, edge == 0 ? 1 : last - 1);
    for (int x = 0; x < width; ++x) to[x] = beyond(to[x], strength * inner[x]);
  }
  if (tiles_x(wraps)) {
    to[-1] = to[width - 1];
    to[width] = to[0];
  } else {
    to[-1] = beyond(to[0], to[std::min(1, width - 1)]);
    to[width] = beyond(to[width - 1], to[std::max(0, width - 2)]);
  }
}

}  // namespace

void check_height(const Image& height) {
  if (height.empty()) throw Error("a height map is empty");
  if (height.channels != 1)
    throw Error("a height map has {} channels, allowed is 1", height.channels);
}

void for_each_ground_row(const Image& height, double strength, Tile wraps,
                         const std::function<void(int y, const GroundRows& rows)>& row) {
  check_height(height);
  const auto pixels_high = static_cast<float>(strength);
  const auto length = static_cast<std::size_t>(height.width) + 2;
  parallel_for(height.height, rows_at_once, [&](std::int64_t begin, std::int64_t end) {
    std::vector<float> memory(3 * length);
    float* above = memory.data() + 1;
    float* here = above + length;
    float* below = here + length;
    copy_ground(height, static_cast<int>(begin) - 1, pixels_high, wraps, above);
    copy_ground(height, static_cast<int>(begin), pixels_high, wraps, here);
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      copy_ground(height, y + 1, pixels_high, wraps, below);
      row(y, {above, here, below});
      std::swap(above, here);
      std::swap(here, below);
    }
  });
}

}  // namespace gramloom
