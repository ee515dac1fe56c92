#pragma once

#include <algorithm>

namespace gramloom {

/// The index of a neighbour that may lie outside [0, count): the other side's on an axis that
/// wraps, else the edge's.
inline int neighbour(int i, int count, bool wraps) {
  if (wraps) return ((i % count) + count) % count;
  return std::clamp(i, 0, count - 1);
}

}  // namespace gramloom
