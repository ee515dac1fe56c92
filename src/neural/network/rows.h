#pragma once

#include "neural/network/feature_maps.h"

namespace gramloom::neural {

/// Rows `begin` to `end` (exclusive) of something. Where its axis wraps they may lie beyond its
/// edges: row −1 is its last one.
struct Rows {
  std::int64_t begin = 0;
  std::int64_t end = 0;

  std::int64_t count() const { return end - begin; }
  bool empty() const { return end <= begin; }
  friend bool operator==(const Rows&, const Rows&) = default;
};

/// n / d rounded down, d > 0.
constexpr std::int64_t floor_divided(std::int64_t n, std::int64_t d) {
  return n / d - (n % d < 0 ? 1 : 0);
}
/// The least rows that hold both; empty rows hold nothing.
Rows hull(Rows a, Rows b);
/// Share `i` of `count` rows shared out among `shares`.
Rows share_of(std::int64_t count, std::int64_t i, std::int64_t shares);

/// Some rows, across the whole width, of a picture or of feature maps that are `height` rows high.
struct HeldRows {
  at::Tensor data;  // (channels, rows, width), or FeatureMaps::data
  std::int64_t channels = 0;
  Rows rows;
  std::int64_t height = 0;

  bool whole() const { return rows == Rows{0, height}; }
  bool is_picture() const { return data.dim() == 3; }
  FeatureMaps maps() const { return {data, channels}; }
  /// Of the whole.
  Size size() const { return {static_cast<int>(data.size(2)), static_cast<int>(height)}; }
};

/// All rows of a picture (channels, height, width).
HeldRows all_rows(const at::Tensor& picture);

/// Which of the held rows row `row` is, around a circle of `height` rows; counted from held.begin.
std::int64_t held_copy(std::int64_t row, Rows held, std::int64_t height);

/// The rows that rows `wanted` are made of, given what lies beyond the edges. Around a circle that
/// is no more than all of them.
Rows rows_behind(Rows wanted, std::int64_t height, Padding padding);
/// Rows `wanted` of these; at least rows_behind() them are known.
at::Tensor take_rows(const HeldRows& known, Rows wanted, Padding padding);

}  // namespace gramloom::neural
