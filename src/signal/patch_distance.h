#pragma once

#include <cstddef>

#include "core/simd.h"
#include "signal/patch_field.h"

namespace gramloom {

namespace detail {

constexpr int lanes = 8;
typedef float Lanes __attribute__((vector_size(lanes * sizeof(float)), aligned(4), may_alias));
constexpr int row_lanes = field_patch * field_features / lanes;

GRAMLOOM_INLINE float sum_of(const Lanes (&sums)[row_lanes]) {
  const Lanes sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

/// Adds the squares of two lines of the patches, and goes on to the next.
GRAMLOOM_INLINE void add_lines(Lanes (&sums)[row_lanes], const float*& a, std::ptrdiff_t a_row,
                               const float*& b, std::ptrdiff_t b_row) {
  for (int y = 0; y < 2; ++y, a += a_row, b += b_row)
    for (int k = 0; k < row_lanes; ++k) {
      const Lanes d = reinterpret_cast<const Lanes*>(a)[k] - reinterpret_cast<const Lanes*>(b)[k];
      sums[k] += d * d;
    }
}

}  // namespace detail

/// Squared distance of two patches, whose rows are `a_row` and `b_row` values apart; at least
/// `limit`, but not all of it, when the rows looked at come to that. Most do in the first two.
GRAMLOOM_INLINE float squared_distance(const float* a, std::ptrdiff_t a_row, const float* b,
                                       std::ptrdiff_t b_row, float limit) {
  float total = 0;
  for (int half = 0; half < 2; ++half) {
    detail::Lanes sums[detail::row_lanes] = {};
    detail::add_lines(sums, a, a_row, b, b_row);
    const float first = total + detail::sum_of(sums);
    if (first >= limit) return first;
    detail::add_lines(sums, a, a_row, b, b_row);
    total += detail::sum_of(sums);
    if (total >= limit) return total;
  }
  return total;
}

/// The same, all of it.
GRAMLOOM_INLINE float squared_distance(const float* a, std::ptrdiff_t a_row, const float* b,
                                       std::ptrdiff_t b_row) {
  float total = 0;
  for (int half = 0; half < 2; ++half) {
    detail::Lanes sums[detail::row_lanes] = {};
    detail::add_lines(sums, a, a_row, b, b_row);
    detail::add_lines(sums, a, a_row, b, b_row);
    total += detail::sum_of(sums);
  }
  return total;
}

}  // namespace gramloom
