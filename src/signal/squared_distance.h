#pragma once

#include <cstddef>

namespace gramloom {

/// Of two lists of `count` values.
inline float squared_distance(const float* a, const float* b, std::size_t count) {
  float sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

}  // namespace gramloom
