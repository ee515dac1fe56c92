#include "procedural/canvas.h"

#include <algorithm>
#include <cmath>

namespace gramloom {

bool Canvas::wraps(int axis) const {
  if (axis == loop_axis) return true;
  return (axis == 0 && tiles_x(tile)) || (axis == 1 && tiles_y(tile));
}

float Canvas::extent(int axis) const {
  if (axis == loop_axis) return loop_length;
  return axis == 0 ? width : height;
}

double Canvas::count(int axis, double per_feature, int multiple) const {
  const double fits = per_feature * static_cast<double>(extent(axis));
  if (!wraps(axis)) return fits;
  return std::max(1.0, std::round(fits / multiple)) * multiple;
}

double Canvas::frequency(int axis, double per_feature, int multiple) const {
  if (!wraps(axis)) return per_feature;
  return count(axis, per_feature, multiple) / static_cast<double>(extent(axis));
}

Lattice<2> Canvas::grid(std::uint32_t layer, double columns, double rows, int column_multiple,
                        int row_multiple) const {
  Lattice<2> result;
  result.frequency = {static_cast<float>(frequency(0, columns, column_multiple)),
                      static_cast<float>(frequency(1, rows, row_multiple))};
  if (wraps(0)) result.period[0] = static_cast<int>(count(0, columns, column_multiple));
  if (wraps(1)) result.period[1] = static_cast<int>(count(1, rows, row_multiple));
  result.seed = random.stream(layer).bits();
  return result;
}

}  // namespace gramloom
