#include "procedural/ground.h"

#include "procedural/cellular.h"
#include "procedural/grid.h"
#include "procedural/ramp.h"
#include "procedural/render.h"

namespace gramloom {

namespace {

struct Stone {
  Floats depth;  // inside its outline, in features
  Floats height;
  Rgb colour;
};

struct PebblesShader {
  Lattice<2> large, small;
  Warp<2> uneven;
  float half_gap, rounding, stripes, footprint;
  Fractal<2> mottle, bands, speckle;
  Ramp ramp;
  Rgb sand_colour;

  GRAMLOOM_INLINE Stone stone(const Lattice<2>& lattice, const Point<2>& p, float round) const {
    const Cells cell = cells(lattice, p, 0.8f, round);
    const float size = 1 / lattice.frequency[0];
    Stone result;
    result.depth = size * (cell.rounded - half_gap * (1 + unit_float(cell.id, 3)));
    const Floats dome = clamp(2.6f * result.depth / size);
    result.height = sqrt(dome * (2 - dome)) * (0.8f + 0.2f * unit_float(cell.id, 4));
    // Each stone has its own rock: colour, mottling, and layers across it in its own direction.
    const Point<2> own{
        {p.at[0] + 9 * unit_float(cell.id, 5), p.at[1] + 9 * unit_float(cell.id, 6)}};
    const Floats spots = unit_sum(mottle, own);
    const Floats angle = unit_float(cell.id, 7);
    const Floats across = cell.dx * cos_turns(angle) + cell.dy * sin_turns(angle);
    const Floats layer = sin_turns(2.5f * across + 0.8f * unit_sum(bands, own)) *
                         smoothstep(0.55f, 0.75f, unit_float(cell.id, 8));
    result.colour = colour_at(ramp, unit_float(cell.id, 9) + 0.12f * spots) *
                    (0.92f + 0.25f * spots + stripes * 0.22f * layer +
                     0.16f * (unit_float(cell.id, 10) - 0.5f));
    return result;
  }
  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Point<2> moved = warped(uneven, p);
    const Floats speck = unit_sum(speckle, p);
    const Stone top = stone(large, moved, rounding);
    const Stone below = stone(small, moved, rounding);
    const Floats on_top = coverage(top.depth, footprint),
                 on_small = coverage(below.depth, footprint);
    const Rgb ground =
        mix(sand_colour * (0.75f + 0.6f * speck), below.colour * (0.62f + 0.15f * speck), on_small);
    const Floats low = 0.10f + 0.05f * speck + 0.22f * below.height * on_small;
    const Floats high = 0.30f + 0.68f * top.height + 0.015f * speck;
    return {mix(ground, top.colour * (1 + 0.16f * speck), on_top), mix(low, high, on_top), on_top};
  }
};

struct CrackedMudShader {
  Lattice<2> plates, pieces;
  Warp<2> ragged;
  float half_crack, fine, curl, footprint;
  Fractal<2> width, dust, grain, patches;
  Ramp ramp;
  Rgb crack_colour;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Point<2> moved = warped(ragged, p);
    const Cells plate = cells(plates, moved, 0.9f);
    const float size = 1 / plates.frequency[0];
    const Floats depth = size * plate.border - half_crack * (1 + 0.9f * unit_sum(width, p));
    const Floats solid_mud = coverage(depth, footprint);
    // A second generation of cracks, thin, in some of the plates, dying out here and there.
    const Cells piece = cells(pieces, moved, 0.95f);
    const Floats alive = fine * smoothstep(-0.25f, 0.25f, unit_sum(patches, p)) *
                         smoothstep(0.25f, 0.5f, unit_float(plate.id, 3));
    const Floats split =
        alive * (1 - smoothstep(0.01f, 0.045f, piece.border / pieces.frequency[0]));

    const Floats sand = unit_sum(grain, p), cloud = unit_sum(dust, p);
    const Floats rim = 1 - clamp(depth / 0.16f);
    const Floats tone =
        0.45f + 0.5f * (unit_float(plate.id, 4) - 0.5f) + 0.45f * cloud + 0.25f * rim * rim;
    const Rgb mud = colour_at(ramp, tone) * ((1 + 0.16f * sand) * (1 - 0.5f * split));
    const Floats tilt =
        (unit_float(plate.id, 5) - 0.5f) * plate.dx + (unit_float(plate.id, 6) - 0.5f) * plate.dy;
    const Floats edge = smoothstep(-0.015f, 0.03f, depth);
    const Floats top = 0.70f + 0.25f * curl * rim * rim + 0.22f * tilt + 0.06f * sand +
                       0.10f * cloud - 0.30f * split;
    return {mix(crack_colour * (1 + 0.5f * sand), mud, solid_mud), mix(splat(0.05f), top, edge),
            1 - solid_mud};
  }
};

struct GrassShader {
  static constexpr int max_layers = 24;
  int layers;
  std::array<Lattice<2>, max_layers> roots;
  float half_width, combing, dry, footprint;
  Fractal<2> patches;
  Ramp ramp;
  Rgb dry_colour, soil;

  // A blade is a bent line from its root, tapering to its tip. Its point nearest to the sample is
  // found along the chord, from which the bend leads away.
  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Floats patch = unit_sum(patches, p);
    Rgb colour = soil * (1 + 0.3f * patch);
    Floats height = Floats{};
    for (int layer = 0; layer < layers; ++layer) {
      const Lattice<2>& lattice = roots[static_cast<std::size_t>(layer)];
      const Floats x[2] = {p.at[0] * lattice.frequency[0] + lattice.offset[0],
                           p.at[1] * lattice.frequency[1] + lattice.offset[1]};
      const Ints base[2] = {to_ints(floor(x[0])), to_ints(floor(x[1]))};
      const Floats offset[2] = {fraction(x[0]), fraction(x[1])};
      const float level = (static_cast<float>(layer) + 0.5f) / static_cast<float>(layers);
      for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) {
          if (i * j == 4 || i * j == -4) continue;
          const FeaturePoint root = feature_point(lattice, base, offset, i, j, 1);
          const Floats rx = -root.dx / lattice.frequency[0], ry = -root.dy / lattice.frequency[1];
          const Floats angle = 0.75f + (1 - combing) * (unit_float(root.id, 3) - 0.5f) +
                               0.12f * (unit_float(root.id, 4) - 0.5f);
          const Floats ax = cos_turns(angle), ay = sin_turns(angle);
          const Floats length = (0.55f + 0.45f * unit_float(root.id, 5)) * 2 / lattice.frequency[0];
          const Floats along = (rx * ax + ry * ay) / length;
          const Floats bend = 0.5f * (unit_float(root.id, 6) - 0.5f) * length;
          const Floats across = ry * ax - rx * ay - bend * along * along;
          const Floats width =
              half_width * (0.6f + 0.6f * unit_float(root.id, 7)) * (1 - square(clamp(along)));
          const Floats inside = coverage(width - abs(across), footprint) *
                                coverage(along * length, footprint) *
                                coverage((1 - along) * length, footprint);
          // Light along the blade: dark at the root, a bright rib's one side, lighter tips.
          const Floats side = across / max(width, 1e-4f);
          const Floats tone = 0.10f + 0.42f * level + 0.34f * along +
                              0.22f * (unit_float(root.id, 8) - 0.5f) + 0.12f * patch;
          const Floats light = 0.95f - 0.20f * side + 0.10f * (1 - abs(side));
          const Floats parched =
              to_floats(-Ints(unit_float(root.id, 9) < dry)) * (0.35f + 0.5f * along);
          const Rgb blade =
              mix(colour_at(ramp, tone), dry_colour * splat(0.5f + 0.6f * level), parched) * light;
          // What lies under a blade is in its shadow.
          const Floats shadow = coverage(width + 0.04f - abs(across + 0.02f), 0.06f) *
                                coverage(along * length, 0.03f) *
                                coverage((1 - along) * length, 0.03f);
          colour = mix(colour * (1 - 0.30f * shadow), blade, inside);
          height = mix(height, level * 0.7f + 0.3f * along, inside);
        }
    }
    return {colour, height};
  }
};

struct SandShader {
  float frequency, grain;
  Fractal<2> stray, strength, grains, tint;
  float waviness;
  Ramp ramp;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Floats phase = frequency * p.at[1] + waviness * 2.2f * unit_sum(stray, p);
    // A long slope up the wind, a short one behind: the sine is pushed over by itself.
    const Floats wave = 0.5f + 0.5f * sin_turns(phase + 0.09f * sin_turns(phase));
    const Floats crest = wave * (0.65f + 0.6f * unit_sum(strength, p));
    const Floats speck = unit_sum(grains, p);
    const Floats height = 0.15f + 0.75f * crest + 0.05f * grain * speck;
    const Floats tone = 0.25f + 0.5f * crest + 0.25f * unit_sum(tint, p);
    return {colour_at(ramp, tone) * (1 + 0.5f * grain * speck), clamp(height)};
  }
};

}  // namespace

Texture paint(const Pebbles& params, const Canvas& canvas) {
  const PebblesShader shader{canvas.lattice<2>(1, 1),
                             canvas.lattice<2>(2, 2.3),
                             canvas.warp<2>(3, 1.5, 2, 0.10),
                             static_cast<float>(params.gap / 2),
                             static_cast<float>(params.roundness),
                             static_cast<float>(params.stripes),
                             canvas.footprint(),
                             canvas.fractal<2>(4, 3, 4, 0.65),
                             canvas.fractal<2>(5, 1.2, 3),
                             canvas.fractal<2>(6, 14, 3, 0.8),
                             make_ramp("colours", params.colours),
                             splat(make_colour("sand_colour", params.sand_colour))};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

Texture paint(const CrackedMud& params, const Canvas& canvas) {
  const CrackedMudShader shader{canvas.lattice<2>(1, 1),
                                canvas.lattice<2>(2, 2.1),
                                canvas.warp<2>(3, 1.6, 4, 0.20),
                                static_cast<float>(params.crack / 2),
                                static_cast<float>(params.fine_cracks),
                                static_cast<float>(params.curl),
                                canvas.footprint(),
                                canvas.fractal<2>(4, 1.2, 3),
                                canvas.fractal<2>(5, 1.5, 5, 0.6),
                                canvas.fractal<2>(6, 13, 3, 0.8),
                                canvas.fractal<2>(7, 0.8, 2),
                                make_ramp("colours", params.colours),
                                splat(make_colour("crack_colour", params.crack_colour))};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

Texture paint(const Grass& params, const Canvas& canvas) {
  GrassShader shader{params.layers,
                     {},
                     static_cast<float>(params.blade_width / 2),
                     static_cast<float>(params.combing),
                     static_cast<float>(params.dry),
                     canvas.footprint(),
                     canvas.fractal<2>(1, 0.6, 3),
                     make_ramp("colours", params.colours),
                     splat(make_colour("dry_colour", params.dry_colour)),
                     splat({0.10f, 0.09f, 0.04f})};
  for (int layer = 0; layer < params.layers; ++layer) {
    const auto stream = static_cast<std::uint32_t>(100 + layer);
    Lattice<2>& roots = shader.roots[static_cast<std::size_t>(layer)];
    roots = canvas.lattice<2>(stream, 2.4);
    Random shift = canvas.random.stream(stream).stream(1);
    for (float& offset : roots.offset) offset = shift.uniform();
  }
  return render(shader, canvas, {.height = true});
}

Texture paint(const Sand& params, const Canvas& canvas) {
  const SandShader shader{
      static_cast<float>(canvas.frequency(1, 1)), static_cast<float>(params.grain),
      canvas.fractal<2>(1, {0.22, 0.4}, 2, 0.4),  canvas.fractal<2>(2, {0.35, 0.8}, 2),
      canvas.fractal<2>(3, 16, 2, 0.9),           canvas.fractal<2>(4, 0.3, 4),
      static_cast<float>(params.waviness),        make_ramp("colours", params.colours)};
  Texture texture = render(shader, canvas, {.height = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

}  // namespace gramloom
