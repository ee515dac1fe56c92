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

/// Σ amplitude · noise: around 0, within ± total.
template <int D, class Basis = ImprovedNoise<>>
GRAMLOOM_INLINE Floats fractal_sum(const Fractal<D>& fractal, const Point<D>& p,
                                   const Basis& basis = {}) {
  Floats sum{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(fractal.octaves); ++k)
    sum += fractal.amplitude[k] * noise(fractal.lattice[k], p, basis);
  return sum;
}

/// The same over total: within ± 1.
template <int D>
GRAMLOOM_INLINE Floats unit_sum(const Fractal<D>& fractal, const Point<D>& p) {
  return fractal_sum(fractal, p) / fractal.total;
}

/// Σ amplitude · |noise|: in [0, total], with creases where the noise is zero (Perlin 1985).
template <int D, class Basis = ImprovedNoise<>>
GRAMLOOM_INLINE Floats turbulence(const Fractal<D>& fractal, const Point<D>& p,
                                  const Basis& basis = {}) {
  Floats sum{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(fractal.octaves); ++k)
    sum += fractal.amplitude[k] * abs(noise(fractal.lattice[k], p, basis));
  return sum;
}

/// (1 − |noise|)²: 1 on a ridge.
GRAMLOOM_INLINE Floats ridge_of(Floats noise) { return square(1 - min(abs(noise), 1.0f)); }

/// Σ amplitude · (1 − |noise|)², each octave weighted by the one before: sharp ridges that branch
/// (Musgrave 1994, "Texturing and Modeling", with offset 1); in [0, total].
template <int D, class Basis = ImprovedNoise<>>
GRAMLOOM_INLINE Floats ridged(const Fractal<D>& fractal, const Point<D>& p,
                              const Basis& basis = {}) {
  Floats sum{};
  Floats weight = splat(1);
  for (std::size_t k = 0; k < static_cast<std::size_t>(fractal.octaves); ++k) {
    const Floats ridge = ridge_of(noise(fractal.lattice[k], p, basis)) * weight;
    sum += fractal.amplitude[k] * ridge;
    weight = clamp(2 * ridge);
  }
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
