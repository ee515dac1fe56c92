#include "procedural/fractal.h"

#include "core/simd.h"

namespace gramloom {

namespace {

template <int D>
GRAMLOOM_INLINE Floats octave(const Fractal<D>& fractal, std::size_t k, const Point<D>& p) {
  return noise(fractal.lattice[k], p);
}

}  // namespace

namespace detail {

template <int D>
GRAMLOOM_SIMD void fractal_sum(const Fractal<D>& fractal, const Point<D>& p, Floats& sum) {
  sum = Floats{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(fractal.octaves); ++k)
    sum += fractal.amplitude[k] * octave(fractal, k, p);
}

template <int D>
GRAMLOOM_SIMD void turbulence(const Fractal<D>& fractal, const Point<D>& p, Floats& sum) {
  sum = Floats{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(fractal.octaves); ++k)
    sum += fractal.amplitude[k] * abs(octave(fractal, k, p));
}

template <int D>
GRAMLOOM_SIMD void ridged(const Fractal<D>& fractal, const Point<D>& p, Floats& sum) {
  sum = Floats{};
  Floats weight = splat(1);
  for (std::size_t k = 0; k < static_cast<std::size_t>(fractal.octaves); ++k) {
    const Floats ridge = ridge_of(octave(fractal, k, p)) * weight;
    sum += fractal.amplitude[k] * ridge;
    weight = clamp(2 * ridge);
  }
}

#define GRAMLOOM_INSTANTIATE(D)                                           \
  template void fractal_sum(const Fractal<D>&, const Point<D>&, Floats&); \
  template void turbulence(const Fractal<D>&, const Point<D>&, Floats&);  \
  template void ridged(const Fractal<D>&, const Point<D>&, Floats&);
GRAMLOOM_INSTANTIATE(1)
GRAMLOOM_INSTANTIATE(2)
GRAMLOOM_INSTANTIATE(3)
GRAMLOOM_INSTANTIATE(4)
#undef GRAMLOOM_INSTANTIATE

}  // namespace detail

}  // namespace gramloom
