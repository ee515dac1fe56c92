#pragma once

#include <array>
#include <cstddef>

#include "procedural/pack.h"

namespace gramloom {

/// The same point in all lanes.
template <int D>
Point<D> point(const std::array<float, D>& x) {
  Point<D> p;
  for (int d = 0; d < D; ++d) p.at[d] = splat(x[static_cast<std::size_t>(d)]);
  return p;
}

/// f(Point<D>) → Floats at one point.
template <int D, class F>
float sample(const F& f, const std::array<float, D>& x) {
  return f(point<D>(x))[0];
}

}  // namespace gramloom
