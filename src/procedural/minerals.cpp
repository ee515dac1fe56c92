#include "procedural/minerals.h"

#include <cmath>

#include "procedural/cellular.h"
#include "procedural/ramp.h"
#include "procedural/render.h"

namespace gramloom {

namespace {

constexpr float per_radian = 0.15915494f;  // turns

struct MarbleShader {
  std::array<float, 3> k;
  float amplitude;
  int power;
  float veins;
  Fractal<3> bend;
  Fractal<3> vein_path;
  Fractal<3> vein_strength;
  Fractal<3> cloud;
  Ramp ramp;
  Rgb vein_colour;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<3> p = solid(q);
    const Floats layers = k[0] * p.at[0] + k[1] * p.at[1] + k[2] * p.at[2];
    const Floats bent = turbulence(bend, p);
    const Floats sine = 0.5f + 0.5f * sin_turns(layers + per_radian * amplitude * bent);
    Floats t = sine;
    if (power > 0) t = 1 - pow(sine, static_cast<float>(power));
    Rgb colour = colour_at(ramp, t);
    if (veins > 0) {
      const Floats path = unit_sum(vein_path, p) + 0.15f * (bent - 0.5f);
      const Floats strength = veins * smoothstep(-0.15f, 0.45f, unit_sum(vein_strength, p));
      const Floats line = pow(1 - min(abs(path) * 2.0f, 1.0f), 14);
      const Floats halo = pow(1 - min(abs(path) * 2.0f, 1.0f), 4);
      colour = mix(colour, vein_colour, strength * clamp(0.85f * line + 0.18f * halo));
      colour = colour * (1 + 0.07f * unit_sum(cloud, p));
    }
    return {colour, t};
  }
};

struct GraniteShader {
  Lattice<2> grains, flakes, specks;
  Warp<2> ragged;
  Fractal<2> within, fine;
  float mica, contrast;
  Ramp ramp;
  int colours;
  Rgb mica_colour;
  std::array<float, 3> mean;

  GRAMLOOM_INLINE Rgb mineral(const Cells& cell, Floats shade) const {
    const Floats which = floor(unit_float(cell.id, 3) * static_cast<float>(colours)) /
                         static_cast<float>(std::max(1, colours - 1));
    const Rgb colour = mix(splat(mean), colour_at(ramp, which), splat(contrast));
    return colour * (0.9f + 0.2f * unit_float(cell.id, 4) + shade);
  }
  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Point<2> moved = warped(ragged, p);
    const Floats grain = unit_sum(fine, p);
    const Cells big = cells(grains, moved, 1);
    const Point<2> own{{p.at[0] + 9 * unit_float(big.id, 5), p.at[1] + 9 * unit_float(big.id, 6)}};
    Rgb colour = mineral(big, 0.35f * unit_sum(within, own) + 0.30f * grain);
    // Thin dark seams between grains.
    colour = colour * (0.84f + 0.16f * smoothstep(0, 0.10f, big.border));
    const Cells flake = cells(flakes, moved, 1);
    const Floats dark = smoothstep(0.0f, 0.10f, flake.border - 0.04f) *
                        to_floats(-Ints(unit_float(flake.id, 3) < mica));
    colour =
        mix(colour, mica_colour * (1 + 2.2f * unit_float(flake.id, 4) + 1.5f * grain), 0.9f * dark);
    const Cells speck = cells(specks, moved, 1);
    const Floats small = smoothstep(0.05f, 0.2f, speck.border) *
                         to_floats(-Ints(unit_float(speck.id, 3) < 0.4f * mica));
    colour = mix(colour, mica_colour * (1.2f + 1.5f * unit_float(speck.id, 4)), 0.8f * small);
    return {colour};
  }
};

struct StuccoShader {
  Warp<2> sweep;
  Fractal<2> lumps, grit, stain;
  float flattened;
  Ramp ramp;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Floats lump = 0.5f + 0.9f * unit_sum(lumps, warped(sweep, p));
    // Drops of plaster thrown at the wall, then levelled with a board: islands with flat tops.
    const Floats island = smoothstep(0.42f, 0.58f, lump);
    const Floats thrown = clamp(lump);
    const Floats level = mix(thrown, 0.25f + 0.5f * island, splat(flattened));
    const Floats grain = unit_sum(grit, p);
    const Floats height = 0.12f + 0.75f * level + (0.14f - 0.08f * flattened * island) * grain;
    const Floats tone = 0.25f + 0.6f * level + 0.3f * unit_sum(stain, p);
    return {colour_at(ramp, tone) * (1 + 0.10f * grain), clamp(height)};
  }
};

}  // namespace

Texture paint(const Marble& params, const Canvas& canvas) {
  if (params.layers.size() != 3)
    throw ConfigError("layers: three numbers, along x, y and depth; here are {}",
                      params.layers.size());
  MarbleShader shader{{},
                      static_cast<float>(params.amplitude),
                      params.power,
                      static_cast<float>(params.veins),
                      canvas.fractal<3>(1, 0.5, params.octaves, params.gain, params.lacunarity),
                      canvas.fractal<3>(2, 0.35, 6, 0.55),
                      canvas.fractal<3>(3, 0.5, 3),
                      canvas.fractal<3>(4, 1.5, 5, 0.7),
                      make_ramp("colours", params.colours, params.positions, params.curve),
                      splat(make_colour("vein_colour", params.vein_colour))};
  for (int d = 0; d < 3; ++d) {
    const double layers = params.layers[static_cast<std::size_t>(d)];
    const double frequency = layers == 0 ? 0 : canvas.frequency(d, std::abs(layers));
    shader.k[static_cast<std::size_t>(d)] = static_cast<float>(std::copysign(frequency, layers));
  }
  return render(shader, canvas);
}

Texture paint(const Granite& params, const Canvas& canvas) {
  const Ramp ramp = make_ramp("colours", params.colours);
  std::array<float, 3> mean{};
  const auto colours = params.colours.size() / 3;
  for (std::size_t i = 0; i < params.colours.size(); ++i)
    mean[i % 3] += static_cast<float>(params.colours[i]) / static_cast<float>(colours);
  const GraniteShader shader{canvas.lattice<2>(1, 1.5),
                             canvas.lattice<2>(2, 2.6),
                             canvas.lattice<2>(3, 6),
                             canvas.warp<2>(4, 4, 3, 0.14),
                             canvas.fractal<2>(5, 3, 4, 0.6),
                             canvas.fractal<2>(6, 14, 3, 0.8),
                             static_cast<float>(params.mica),
                             static_cast<float>(params.contrast),
                             ramp,
                             static_cast<int>(colours),
                             splat(make_colour("mica_colour", params.mica_colour)),
                             mean};
  return render(shader, canvas);
}

Texture paint(const Stucco& params, const Canvas& canvas) {
  const StuccoShader shader{
      canvas.warp<2>(1, 1.2, 3, 0.25),      canvas.fractal<2>(2, 1, 5, 0.4),
      canvas.fractal<2>(3, 12, 3, 0.8),     canvas.fractal<2>(4, 0.4, 4),
      static_cast<float>(params.flattened), make_ramp("colours", params.colours)};
  Texture texture = render(shader, canvas, {.height = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

}  // namespace gramloom
