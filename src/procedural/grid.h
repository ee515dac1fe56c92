#pragma once

#include "procedural/noise.h"

namespace gramloom {

// Cells of regular patterns, and distances inside them in features.

/// The cell of a grid that a point lies in.
struct GridCell {
  Floats x, y;          // from the cell's middle, in features
  Floats column, row;   // which cell; not wrapped
  Uints id;             // random bits of the cell
  float width, height;  // of a cell, in features
};

/// `shift`: by how much of a cell every odd row is shifted to the left.
GRAMLOOM_INLINE GridCell grid_cell(const Lattice<2>& grid, const Point<2>& p, float shift = 0) {
  GridCell cell;
  cell.width = 1 / grid.frequency[0];
  cell.height = 1 / grid.frequency[1];
  const Floats v = p.at[1] * grid.frequency[1];
  cell.row = floor(v);
  const Floats odd = cell.row - 2 * floor(cell.row * 0.5f);
  const Floats u = p.at[0] * grid.frequency[0] + shift * odd;
  cell.column = floor(u);
  cell.x = (u - cell.column - 0.5f) * cell.width;
  cell.y = (v - cell.row - 0.5f) * cell.height;
  const Ints at[2] = {wrap(to_ints(cell.column), grid.period[0]),
                      wrap(to_ints(cell.row), grid.period[1])};
  cell.id = ArithmeticHash{grid.seed}(at);
  return cell;
}

/// How deep (x, y) lies inside a rectangle of this half width and half height around 0 with corners
/// of this radius; negative outside.
GRAMLOOM_INLINE Floats depth_in_box(Floats x, Floats y, Floats half_width, Floats half_height,
                                    float radius) {
  const Floats qx = abs(x) - half_width + radius;
  const Floats qy = abs(y) - half_height + radius;
  const Floats ox = max(qx, 0.0f), oy = max(qy, 0.0f);
  return radius - sqrt(ox * ox + oy * oy) - min(max(qx, qy), 0.0f);
}

/// How much of a sample's footprint lies on the inner side of an edge: 0 to 1 over one footprint.
GRAMLOOM_INLINE Floats coverage(Floats depth, float footprint) {
  return clamp(depth / footprint + 0.5f);
}

}  // namespace gramloom
