#include "procedural/noise_texture.h"

#include "procedural/cellular.h"
#include "procedural/render.h"

namespace gramloom {

namespace {

template <int D, class Basis>
struct NoiseShader {
  Basis basis;
  NoiseSum sum;
  Fractal<D> fractal;
  Warp<D> warp;
  Ramp ramp;
  float contrast;
  float levels;

  // As fractal_sum, turbulence and ridged, in one loop: noise of so many kinds is much code.
  GRAMLOOM_INLINE Floats value(const Point<D>& p) const {
    Floats total{};
    Floats weight = splat(1);
    for (std::size_t k = 0; k < static_cast<std::size_t>(fractal.octaves); ++k) {
      const Floats n = noise(fractal.lattice[k], p, basis);
      Floats term = n;
      if (sum == NoiseSum::turbulence) term = 2 * abs(n) - 1;
      if (sum == NoiseSum::ridged) {
        const Floats ridge = ridge_of(n) * weight;
        term = 2 * ridge - 1;
        weight = clamp(2 * ridge);
      }
      total += fractal.amplitude[k] * term;
    }
    return total / fractal.total;
  }
  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    Point<D> p;
    for (int d = 0; d < D; ++d) p.at[d] = q.at[d];
    if (warp.amount > 0) p = warped(warp, p);
    Floats t = 0.5f + 0.5f * contrast * value(p);
    if (levels > 1) t = min(floor(clamp(t) * levels), levels - 1) / (levels - 1);
    return {colour_at(ramp, t), clamp(t)};
  }
};

template <int D, class Basis>
Texture paint_with(const Noise& params, const Canvas& canvas, const Basis& basis) {
  const NoiseShader<D, Basis> shader{
      basis,
      params.sum,
      canvas.fractal<D>(1, 1, params.octaves, params.gain, params.lacunarity),
      canvas.warp<D>(2, 0.5, 3, params.warp),
      make_ramp("colours", params.colours, params.positions, params.curve),
      static_cast<float>(params.contrast),
      static_cast<float>(params.levels)};
  return render(shader, canvas, {.height = true});
}

template <int D>
Texture paint_in(const Noise& params, const Canvas& canvas) {
  switch (params.basis) {
    case NoiseBasis::value_linear:
      return paint_with<D>(params, canvas, ValueNoise<true>{});
    case NoiseBasis::value:
      return paint_with<D>(params, canvas, ValueNoise<>{});
    case NoiseBasis::gradient: {
      const GradientTable table = gradient_table(canvas.random.stream(3));
      return paint_with<D>(params, canvas, GradientNoise{&table});
    }
    case NoiseBasis::improved:
      break;
  }
  return paint_with<D>(params, canvas, ImprovedNoise<>{});
}

struct CellularShader {
  Lattice<2> lattice;
  float jitter;
  CellularFeature feature;
  Ramp ramp;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Cells cell = cells(lattice, flat(q), jitter);
    Floats t = cell.first;
    if (feature == CellularFeature::second) t = cell.second;
    if (feature == CellularFeature::difference) t = cell.second - cell.first;
    if (feature == CellularFeature::border) t = 2 * cell.border;
    if (feature == CellularFeature::cells) t = unit_float(cell.id, 3);
    return {colour_at(ramp, t), clamp(t)};
  }
};

}  // namespace

Texture paint(const Noise& params, const Canvas& canvas) {
  switch (params.dimensions) {
    case 1:
      return paint_in<1>(params, canvas);
    case 2:
      return paint_in<2>(params, canvas);
    case 3:
      return paint_in<3>(params, canvas);
    default:
      return paint_in<4>(params, canvas);
  }
}

Texture paint(const Cellular& params, const Canvas& canvas) {
  const CellularShader shader{canvas.lattice<2>(1, 1), static_cast<float>(params.jitter),
                              params.feature, make_ramp("colours", params.colours)};
  return render(shader, canvas, {.height = true});
}

}  // namespace gramloom
