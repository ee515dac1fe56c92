#include "procedural/cellular.h"

#include "core/simd.h"

namespace gramloom {

namespace {

GRAMLOOM_INLINE Cells cells_around(const Lattice<2>& lattice, const Point<2>& p, float jitter,
                                   float rounding) {
  const Floats x[2] = {p.at[0] * lattice.frequency[0], p.at[1] * lattice.frequency[1]};
  const Ints base[2] = {to_ints(floor(x[0])), to_ints(floor(x[1]))};
  const Floats offset[2] = {fraction(x[0]), fraction(x[1])};

  // Two cells each way: with full jitter the nearest point may lie so far; the corners cannot.
  Cells cell{splat(100), splat(100), splat(100), splat(100), {}, {}, {}};
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      if (i * j == 4 || i * j == -4) continue;
      const FeaturePoint point = feature_point(lattice, base, offset, i, j, jitter);
      const Floats distance = point.dx * point.dx + point.dy * point.dy;
      const Ints nearer = distance < cell.first;
      cell.second = min(cell.second, max(distance, cell.first));
      cell.first = min(cell.first, distance);
      cell.dx = select(nearer, point.dx, cell.dx);
      cell.dy = select(nearer, point.dy, cell.dy);
      cell.id = select(nearer, point.id, cell.id);
    }

  // The border with another point's cell is half way between the two points (Quílez 2012).
  Floats soft{};
  const float sharpness = rounding > 0 ? 1 / rounding : 0;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      const FeaturePoint point = feature_point(lattice, base, offset, i, j, jitter);
      const Floats ax = point.dx - cell.dx, ay = point.dy - cell.dy;
      const Floats apart2 = ax * ax + ay * ay;
      const Floats distance = 0.5f * ((point.dx + cell.dx) * ax + (point.dy + cell.dy) * ay) /
                              sqrt(max(apart2, 1e-12f));
      const Ints other = apart2 > 1e-10f;
      cell.border = min(cell.border, select(other, distance, splat(100)));
      if (rounding > 0) soft += select(other, exp(-sharpness * distance), Floats{});
    }
  cell.rounded = rounding > 0 ? -rounding * log2(max(soft, 1e-30f)) * 0.69314718f : cell.border;
  cell.first = sqrt(cell.first);
  cell.second = sqrt(cell.second);
  cell.dx = -cell.dx;
  cell.dy = -cell.dy;
  return cell;
}

}  // namespace

GRAMLOOM_SIMD void detail::cells(const Lattice<2>& lattice, const Point<2>& p, float jitter,
                                 float rounding, Cells& found) {
  // Most ask for no rounding, and then nothing of it is left in the loop.
  found = rounding > 0 ? cells_around(lattice, p, jitter, rounding)
                       : cells_around(lattice, p, jitter, 0);
}

}  // namespace gramloom
