#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/image.h"
#include "core/random.h"

namespace gramloom {

/// Where a piece of the exemplar lies: the exemplar's point (x', y') of a point (x, y) of the
/// result, in pixels whose middles are at ½.
///   x' = cosine · x − sine · y + x0,  y' = sine · x + cosine · y + y0
struct TilingPiece {
  double cosine = 1, sine = 0;
  double x0 = 0, y0 = 0;  // whole numbers when the piece is not turned
};

/// A corner of the triangle around a point, and its share in it, the three's sum 1.
struct TilingCorner {
  std::int64_t column = 0, row = 0;
  double weight = 0;
};

/// A lattice of nearly equilateral triangles over the plane, and the piece of the exemplar at each
/// of its points (Heitz, Neyret 2018). Point (column, row) lies at
/// (across · (column + row / 2), down · row); its piece covers the six triangles around it.
///
/// Pieces lie inside the exemplar, but for axes on which it wraps: there they may be anywhere.
/// Departures: on axes on which the result tiles, the triangles are stretched so that a whole
/// number fits, and points a period apart have the same piece. Pieces that are not turned are moved
/// by whole pixels, so that nothing is interpolated.
class TilingLattice {
 public:
  struct Shape {
    Size exemplar;
    Tile wraps = Tile::none;            // the exemplar
    Size result;                        // matters only on axes that tile
    Tile tiles = Tile::none;            // the result
    double side = 64;                   // of a triangle, pixels; at least 1
    double rotation = 0;                // degrees
    double period_x = 1, period_y = 1;  // pieces that are not turned move by multiples, rounded
  };
  /// Throws Error for a period of which no multiple fits some of the pieces.
  TilingLattice(const Shape& shape, Random random);

  /// From now on pieces lie where these are not 0: of straight pieces the exemplar's pixel that
  /// their first one is, of turned ones that of their middle; row by row, one at least. Where no
  /// multiple of a period is among them, the nearest is taken.
  void keep_to(std::vector<unsigned char> usable) { usable_ = std::move(usable); }

  /// Sides of a triangle: along a row, and between rows.
  double across() const { return across_; }
  double down() const { return down_; }
  /// Pixels on a side of the largest piece.
  int piece_width() const { return static_cast<int>(2 * across_) + 1; }
  int piece_height() const { return static_cast<int>(2 * down_) + 1; }

  /// The radius of the disc that holds a piece however it is turned.
  double piece_radius() const;

  /// How many places of the exemplar a piece may come from, across and down; of turned pieces,
  /// whose places are not whole pixels, about so many.
  Size places() const;

  /// Of a point in pixels.
  std::array<TilingCorner, 3> around(double x, double y) const;
  TilingPiece piece(std::int64_t column, std::int64_t row) const;

 private:
  struct Point {
    double x, y;
  };
  bool is_usable(double x, double y) const;
  Point nearest_usable(double x, double y) const;

  Shape shape_;
  Random random_;
  double across_, down_;
  std::int64_t columns_ = 0, rows_ = 0;  // of a period; 0: there is none
  std::vector<unsigned char> usable_;    // empty: all are
};

}  // namespace gramloom
