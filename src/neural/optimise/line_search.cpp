#include "neural/optimise/line_search.h"

#include <algorithm>
#include <cmath>

namespace gramloom::neural {

namespace {

constexpr double sufficient_decrease = 1e-4;
constexpr double curvature = 0.9;

// Where the cubic through two points and their slopes has its minimum, kept within [low, high].
double cubic_minimum(const LinePoint& a, const LinePoint& b, double low, double high) {
  const double d1 = a.slope + b.slope - 3 * (a.value - b.value) / (a.t - b.t);
  const double square = d1 * d1 - a.slope * b.slope;
  const double middle = (low + high) / 2;
  if (!(square >= 0)) return middle;
  const double d2 = std::copysign(std::sqrt(square), b.t - a.t);
  const double t = b.t - (b.t - a.t) * (b.slope + d2 - d1) / (b.slope - a.slope + 2 * d2);
  return std::isfinite(t) ? std::clamp(t, low, high) : middle;
}

}  // namespace

LinePoint search_line(const std::function<LinePoint(double)>& evaluate, const LinePoint& start,
                      double first_step, int most) {
  const auto low_enough = [&](const LinePoint& p) {
    return p.value <= start.value + sufficient_decrease * p.t * start.slope;
  };
  const auto flat_enough = [&](const LinePoint& p) {
    return std::abs(p.slope) <= -curvature * start.slope;
  };
  int evaluations = 0;
  LinePoint best = start;
  const auto look = [&](double t) {
    ++evaluations;
    LinePoint point = evaluate(t);
    // A step so long that the loss overflows is just too long.
    if (!std::isfinite(point.value) || !std::isfinite(point.slope))
      point = {t, std::numeric_limits<double>::max() / 4, -start.slope};
    if (point.value < best.value) best = point;
    return point;
  };

  // Bracket: lengthen the step until a minimum lies between `low` and `high`.
  LinePoint previous = start, point = look(first_step), low, high;
  for (;;) {
    if (!low_enough(point) || (evaluations > 1 && point.value >= previous.value)) {
      low = previous;
      high = point;
      break;
    }
    if (flat_enough(point)) return point;
    if (point.slope >= 0) {
      low = point;
      high = previous;
      break;
    }
    if (evaluations >= most) return best;
    const double longer =
        cubic_minimum(previous, point, point.t + 0.01 * (point.t - previous.t), 10 * point.t);
    previous = point;
    point = look(longer);
  }

  // Zoom: `low` is the lowest point with sufficient decrease, the minimum lies towards `high`.
  while (evaluations < most) {
    const double a = std::min(low.t, high.t), b = std::max(low.t, high.t), margin = 0.1 * (b - a);
    if (b - a <= 1e-9 * b) break;
    point = look(cubic_minimum(low, high, a + margin, b - margin));
    if (!low_enough(point) || point.value >= low.value) {
      high = point;
      continue;
    }
    if (flat_enough(point)) return point;
    if (point.slope * (high.t - low.t) >= 0) high = low;
    low = point;
  }
  return best;
}

}  // namespace gramloom::neural
