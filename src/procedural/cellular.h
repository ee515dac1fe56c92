#pragma once

#include "procedural/noise.h"

namespace gramloom {

// Cellular noise (Worley 1996, "A cellular texture basis function") in the plane: one feature point
// in each lattice cell, up to jitter/2 from its centre.

/// What cells are around each point. Distances are in lattice steps.
struct Cells {
  Floats first;    // to the nearest feature point: F1
  Floats second;   // to the second nearest: F2
  Floats border;   // to the border of the nearest one's cell: exact, the same on both sides
  Floats rounded;  // to the border with its corners rounded off; below 0 in the gaps this leaves
  Floats dx, dy;   // from the nearest feature point
  Uints id;        // random bits of the nearest one's cell
};

struct FeaturePoint {
  Floats dx, dy;  // from the sample
  Uints id;
};

/// The feature point of the cell (i, j) away from the sample's.
GRAMLOOM_INLINE FeaturePoint feature_point(const Lattice<2>& lattice, const Ints (&base)[2],
                                           const Floats (&offset)[2], int i, int j, float jitter) {
  const Ints at[2] = {wrap(base[0] + i, lattice.period[0]), wrap(base[1] + j, lattice.period[1])};
  const Uints id = ArithmeticHash{lattice.seed}(at);
  return {static_cast<float>(i) + 0.5f + jitter * (unit_float(id, 1) - 0.5f) - offset[0],
          static_cast<float>(j) + 0.5f + jitter * (unit_float(id, 2) - 0.5f) - offset[1], id};
}

// Compiled once, by cellular.cpp, and not into every shader: it is much code.
namespace detail {
void cells(const Lattice<2>& lattice, const Point<2>& p, float jitter, float rounding,
           Cells& found);
}

/// Exact for jitter in [0, 1]. `rounding` > 0 is the size, in lattice steps, of the rounded
/// corners: a soft minimum over the distances to all neighbours' borders.
GRAMLOOM_INLINE Cells cells(const Lattice<2>& lattice, const Point<2>& p, float jitter,
                            float rounding = 0) {
  Cells cell;
  detail::cells(lattice, p, jitter, rounding, cell);
  return cell;
}

}  // namespace gramloom
