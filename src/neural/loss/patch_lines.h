#pragma once

#include <ATen/ATen.h>

#include <algorithm>

#include "core/image.h"

namespace gramloom::neural {

/// Where k × k patches lie in a picture (channels, height, width) of contiguous floats. Their upper
/// left pixels are the positions; on an axis that wraps every pixel is one.
struct PatchPositions {
  std::int64_t channels, height, width, side;
  std::int64_t rows, columns;  // positions

  PatchPositions(const at::Tensor& picture, std::int64_t side_, Tile wraps)
      : PatchPositions(picture.size(0),
                       {static_cast<int>(picture.size(2)), static_cast<int>(picture.size(1))},
                       side_, wraps) {}
  PatchPositions(std::int64_t channels_, Size size, std::int64_t side_, Tile wraps)
      : channels(channels_),
        height(size.height),
        width(size.width),
        side(side_),
        rows(tiles_y(wraps) ? height : height - side + 1),
        columns(tiles_x(wraps) ? width : width - side + 1) {}

  std::int64_t count() const { return rows * columns; }
  /// Values of a patch.
  std::int64_t taps() const { return channels * side * side; }
};

/// Calls f(where a row of the picture begins, first column) for each value of the patches of
/// positions (x, y), (x + 1, y), … in turn: theirs are the pixels from that column on.
template <class F>
void for_each_tap(const PatchPositions& p, std::int64_t y, std::int64_t x, F&& f) {
  for (std::int64_t c = 0; c < p.channels; ++c)
    for (std::int64_t ky = 0; ky < p.side; ++ky) {
      const std::int64_t row = (c * p.height + (y + ky) % p.height) * p.width;
      for (std::int64_t kx = 0; kx < p.side; ++kx) f(row, x + kx);
    }
}

/// Calls f(first column, place, count) for the pieces of `count` pixels of a row from `column` on,
/// which goes on at its beginning.
template <class F>
void for_each_piece(std::int64_t width, std::int64_t column, std::int64_t count, F&& f) {
  for (std::int64_t place = 0; place < count;) {
    const std::int64_t first = (column + place) % width;
    const std::int64_t some = std::min(count - place, width - first);
    f(first, place, some);
    place += some;
  }
}

}  // namespace gramloom::neural
