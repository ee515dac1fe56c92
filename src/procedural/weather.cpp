#include "procedural/weather.h"

#include "procedural/ramp.h"
#include "procedural/render.h"

namespace gramloom {

namespace {

struct CloudsShader {
  Fractal<3> shape, wisps;
  Warp<3> wind;
  float threshold, edge;
  std::array<float, 2> to_light;
  Ramp sky, ramp;

  GRAMLOOM_INLINE Floats density(const Point<3>& p) const { return unit_sum(shape, p) - threshold; }
  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<3> p = warped(wind, solid(q));
    const Floats thick = density(p);
    // Nearer to the light there is less cloud in front: a shadow falls where there is more.
    const Floats towards = density({{p.at[0] + to_light[0], p.at[1] + to_light[1], p.at[2]}});
    const Floats cover = smoothstep(0, 1, (thick + 0.12f * unit_sum(wisps, p)) / edge);
    const Floats light =
        0.70f + 1.5f * (thick - towards) - 0.55f * max(thick, 0.0f) / (0.3f + max(thick, 0.0f));
    const Floats air = 0.5f + 0.6f * thick;
    return {mix(colour_at(sky, air), colour_at(ramp, light), cover), clamp(0.5f + thick), cover};
  }
};

struct FireShader {
  Fractal<3> licks, swirl;
  Warp<3> turbulent;
  float heat, height;
  bool fades;
  Ramp ramp;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<3> p = solid(q);
    const Point<3> moved = warped(turbulent, p);
    const Floats tongues = ridged(licks, moved) / licks.total;
    const Floats glow = 0.5f + 0.9f * unit_sum(swirl, moved);
    Floats t = (0.25f + heat) * (0.30f + 1.05f * tongues) * (0.35f + 0.9f * glow);
    if (fades) t *= 0.10f + 1.5f * p.at[1] / height;
    return {colour_at(ramp, t), clamp(t)};
  }
};

struct RustShader {
  Fractal<2> spread, tone, crust, pits, runs, wear;
  Warp<2> ragged;
  float threshold, streaks;
  Ramp ramp;
  Rgb paint;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Floats grain = unit_sum(crust, p);
    const Floats level = unit_sum(spread, warped(ragged, p)) + 0.10f * grain - threshold;
    const Floats rust = smoothstep(-0.008f, 0.012f, level);
    const Floats stain = smoothstep(-0.22f, 0.0f, level);
    const Floats pit = smoothstep(0.15f, 0.4f, unit_sum(pits, p));
    const Floats shade =
        0.42f + 0.55f * unit_sum(tone, p) + 0.30f * grain - 0.18f * smoothstep(0.0f, 0.25f, level);
    const Rgb iron = colour_at(ramp, shade) * ((1 + 0.30f * grain) * (1 - 0.40f * pit));
    const Floats run = streaks * smoothstep(0.02f, 0.40f, unit_sum(runs, p));
    const Rgb stained =
        mix(paint * (1 + 0.14f * unit_sum(wear, p) + 0.06f * grain),
            colour_at(ramp, 0.75f + 0.2f * grain), clamp(0.42f * stain * stain + 0.38f * run));
    const Floats blister = 0.12f * stain * (1 - rust);
    const Floats top = 0.66f + blister + 0.02f * grain;
    const Floats bottom = 0.34f + 0.22f * grain - 0.16f * pit;
    return {mix(stained, iron, rust), mix(top, bottom, rust), rust};
  }
};

/// The level that so large a part of a unit_sum of several octaves lies above, about: it is close
/// to normal with a standard deviation of 0.2.
float level_for(double part) { return static_cast<float>(0.8 * (0.5 - part)); }

}  // namespace

Texture paint(const Clouds& params, const Canvas& canvas) {
  const CloudsShader shader{canvas.fractal<3>(1, 0.6, 7, 0.5),
                            canvas.fractal<3>(2, 4, 4, 0.6),
                            canvas.warp<3>(3, 0.6, 3, 0.45),
                            level_for(params.cover),
                            static_cast<float>(0.4 * params.softness),
                            {0.18f * canvas.light[0], 0.18f * canvas.light[1]},
                            make_ramp("sky", params.sky),
                            make_ramp("colours", params.colours)};
  return render(shader, canvas, {.mask = true});
}

Texture paint(const Fire& params, const Canvas& canvas) {
  const double along = 1 / params.stretch;
  const FireShader shader{canvas.fractal<3>(1, {1, along, 1}, 4, 0.5),
                          canvas.fractal<3>(2, {0.5, 0.5 * along, 1}, 4),
                          canvas.warp<3>(3, 0.6, 3, 0.7),
                          static_cast<float>(params.heat),
                          canvas.height,
                          !canvas.wraps(1),
                          make_ramp("colours", params.colours, {}, Curve::spline)};
  return render(shader, canvas);
}

Texture paint(const Rust& params, const Canvas& canvas) {
  const RustShader shader{canvas.fractal<2>(1, 0.7, 6, 0.55),
                          canvas.fractal<2>(2, 0.9, 6, 0.65),
                          canvas.fractal<2>(3, 9, 4, 0.8),
                          canvas.fractal<2>(4, 5, 3, 0.7),
                          canvas.fractal<2>(5, {2.2, 0.12}, 3, 0.6),
                          canvas.fractal<2>(6, 0.8, 5, 0.6),
                          canvas.warp<2>(7, 1, 4, 0.3),
                          level_for(params.cover),
                          static_cast<float>(params.streaks),
                          make_ramp("colours", params.colours),
                          splat(make_colour("paint", params.paint))};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

}  // namespace gramloom
