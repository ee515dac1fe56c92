#pragma once

#include <functional>

namespace gramloom::neural {

/// A point on the line: step t, value f(t), slope f′(t).
struct LinePoint {
  double t = 0, value = 0, slope = 0;
};

/// A step with the strong Wolfe conditions, f(t) ≤ f(0) + c₁ t f′(0) and |f′(t)| ≤ c₂ |f′(0)|
/// (Nocedal, Wright 2006, algorithms 3.5 and 3.6, cubic interpolation), trying `first_step` first.
/// start.slope < 0. When `most` evaluations don't reach both conditions, the lowest point seen.
/// The last point evaluated is not always the one returned.
LinePoint search_line(const std::function<LinePoint(double)>& evaluate, const LinePoint& start,
                      double first_step, int most = 20);

}  // namespace gramloom::neural
