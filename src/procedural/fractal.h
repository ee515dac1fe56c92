#pragma once

#include <array>

#include "procedural/noise.h"

namespace gramloom {

inline constexpr int max_octaves = 16;

/// The octaves of a fractal sum: lattices of rising frequency with falling amplitude. They come
/// from Canvas::fractal, which rounds frequencies where the picture must tile.
template <int D>
struct Fractal {
  int octaves = 0;
  std::array<Lattice<D>, max_octaves> lattice{};
  std::array<float, max_octaves> amplitude{};
  float total = 0;  // of the amplitudes
};

/// (1 − |noise|)²: 1 on a ridge.
GRAMLOOM_INLINE Floats ridge_of(Floats noise) { return square(1 - min(abs(noise), 1.0f)); }

// Compiled once for 1 to 4 dimensions, by fractal.cpp, and not into every shader: it is much code.
namespace detail {
template <int D>
void fractal_sum(const Fractal<D>& fractal, const Point<D>& p, Floats& sum);
template <int D>
void turbulence(const Fractal<D>& fractal, const Point<D>& p, Floats& sum);
template <int D>
void ridged(const Fractal<D>& fractal, const Point<D>& p, Floats& sum);
}  // namespace detail

/// Σ amplitude · noise: around 0, within ± total. The noise of all sums is improved noise.
template <int D>
GRAMLOOM_INLINE Floats fractal_sum(const Fractal<D>& fractal, const Point<D>& p) {
  Floats sum;
  detail::fractal_sum(fractal, p, sum);
  return sum;
}

/// The same over total: within ± 1.
template <int D>
GRAMLOOM_INLINE Floats unit_sum(const Fractal<D>& fractal, const Point<D>& p) {
  return fractal_sum(fractal, p) / fractal.total;
}

/// Σ amplitude · |noise|: in [0, total], with creases where the noise is zero (Perlin 1985).
template <int D>
GRAMLOOM_INLINE Floats turbulence(const Fractal<D>& fractal, const Point<D>& p) {
  Floats sum;
  detail::turbulence(fractal, p, sum);
  return sum;
}

/// Σ amplitude · (1 − |noise|)², each octave weighted by the one before: sharp ridges that branch
/// (Musgrave 1994, "Texturing and Modeling", with offset 1); in [0, total].
template <int D>
GRAMLOOM_INLINE Floats ridged(const Fractal<D>& fractal, const Point<D>& p) {
  Floats sum;
  detail::ridged(fractal, p, sum);
  return sum;
}

/// Domain warping: each coordinate moved by up to ± amount by a fractal sum of its own.
template <int D>
struct Warp {
  std::array<Fractal<D>, D> axis{};
  float amount = 0;
};

template <int D>
GRAMLOOM_INLINE Point<D> warped(const Warp<D>& warp, const Point<D>& p) {
  Point<D> moved;
#pragma GCC unroll 1
  for (int d = 0; d < D; ++d) {
    const Fractal<D>& fractal = warp.axis[static_cast<std::size_t>(d)];
    moved.at[d] = p.at[d] + warp.amount * unit_sum(fractal, p);
  }
  return moved;
}

}  // namespace gramloom
