#pragma once

#include <algorithm>

#include "core/image.h"

namespace gramloom {

/// The index of a neighbour that may lie outside [0, count): the other side's on an axis that
/// wraps, else the edge's.
inline int neighbour(int i, int count, bool wraps) {
  if (wraps) return ((i % count) + count) % count;
  return std::clamp(i, 0, count - 1);
}

/// Throws Error unless `height` is a picture of one channel; `what` names it in the message.
void check_one_channel(const Image& height, const char* what);

/// The slope of a one-channel picture at (x, y) along an axis, a unit a pixel: by central
/// differences, (h(i+1) − h(i−1)) / 2, across the edges of axes that wrap; at an edge that does
/// not, the difference from the one neighbour, so that a ramp has the same slope everywhere. An
/// axis of one pixel is flat.
inline float slope_along_x(const Image& height, int x, int y, Tile wraps) {
  const int before = tiles_x(wraps) ? neighbour(x - 1, height.width, true) : std::max(x - 1, 0);
  const int after =
      tiles_x(wraps) ? neighbour(x + 1, height.width, true) : std::min(x + 1, height.width - 1);
  const int distance = tiles_x(wraps) ? 2 : std::max(after - before, 1);
  return (*height.at(after, y) - *height.at(before, y)) / static_cast<float>(distance);
}
/// Along y, downwards as rows count.
inline float slope_along_y(const Image& height, int x, int y, Tile wraps) {
  const int before = tiles_y(wraps) ? neighbour(y - 1, height.height, true) : std::max(y - 1, 0);
  const int after =
      tiles_y(wraps) ? neighbour(y + 1, height.height, true) : std::min(y + 1, height.height - 1);
  const int distance = tiles_y(wraps) ? 2 : std::max(after - before, 1);
  return (*height.at(x, after) - *height.at(x, before)) / static_cast<float>(distance);
}

}  // namespace gramloom
