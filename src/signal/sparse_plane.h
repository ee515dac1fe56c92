#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/image.h"

namespace gramloom {

/// A float for each place of a plane, most of which are 0: only squares that hold anything else
/// take memory.
class SparsePlane {
 public:
  static constexpr int side = 32;  // of a square
  using Square = std::array<float, side * side>;

  explicit SparsePlane(Size size)
      : columns_((size.width + side - 1) / side),
        squares_(static_cast<std::size_t>(columns_) *
                     static_cast<std::size_t>((size.height + side - 1) / side),
                 nothing) {}

  float at(int x, int y) const {
    return squares_[square(x / side, y / side)][static_cast<unsigned>(y % side * side + x % side)];
  }
  /// Whether all of a square is 0 and without memory.
  bool is_zero(int column, int row) const { return squares_[square(column, row)] == nothing; }
  /// The values of a square, row by row, to be changed.
  float* values(int column, int row) {
    const std::size_t i = square(column, row);
    if (squares_[i] == nothing)
      squares_[i] = held_.emplace_back(std::make_unique<Square>(Square{}))->data();
    return const_cast<float*>(squares_[i]);
  }

 private:
  static constexpr float nothing[side * side] = {};

  std::size_t square(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  int columns_;
  std::vector<const float*> squares_;
  std::vector<std::unique_ptr<Square>> held_;
};

}  // namespace gramloom
