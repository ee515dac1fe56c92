#include "procedural/wood.h"

#include "procedural/cellular.h"
#include "procedural/grid.h"
#include "procedural/ramp.h"
#include "procedural/render.h"

namespace gramloom {

namespace {

/// The solid that boards are sawn from. Points are in rings; the trunk's axis is y.
struct Trunk {
  float sharpness, curl, grain;
  Fractal<3> bend, waver, fibres, pores, tint;
  Ramp ramp;

  GRAMLOOM_INLINE Surface at(Floats radius, const Point<3>& p) const {
    const Floats phase = radius + curl * (6 * unit_sum(bend, p) + 0.4f * unit_sum(waver, p));
    const Floats ring = floor(phase);
    // cos(R)ᵖᵒʷᵉʳ; but late wood darkens slowly and ends at once, so the wave is pushed to one
    // side.
    const Floats t = phase - ring;
    const Floats skewed = t < 0.88f ? t * (0.5f / 0.88f) : 0.5f + (t - 0.88f) * (0.5f / 0.12f);
    const Floats edge = pow(0.5f - 0.5f * cos_turns(skewed), sharpness);
    const Floats year = unit_float(hash(Uints(to_ints(ring)) * 0x9E3779B9u), 1);
    const Floats fibre = unit_sum(fibres, p);
    const Floats pore = smoothstep(0.18f, 0.40f, unit_sum(pores, p)) * (1 - 0.6f * edge);
    const Floats tone = 0.12f + 0.75f * edge * (0.6f + 0.4f * year) + 0.18f * unit_sum(tint, p) +
                        grain * 0.22f * fibre;
    const Floats shade = 1 + grain * (0.45f * fibre - 0.42f * pore);
    return {colour_at(ramp, tone) * shade, 0.75f - 0.25f * grain * pore + 0.1f * fibre};
  }
};

Trunk make_trunk(const Canvas& canvas, double rings_per_feature, double sharpness, double curl,
                 double grain, const std::vector<double>& colours, bool end_grain) {
  const double f = rings_per_feature;
  // Along the axis everything is drawn out; seen from its end, the axis is z.
  const auto drawn = [&](double across, double along) {
    return end_grain ? std::array{across * f, across * f, along * f}
                     : std::array{across * f, along * f, across * f};
  };
  return {static_cast<float>(sharpness),
          static_cast<float>(curl),
          static_cast<float>(grain),
          canvas.fractal<3>(1, drawn(0.12, 0.075), 2, 0.4),
          canvas.fractal<3>(2, drawn(0.8, 0.15), 3),
          canvas.fractal<3>(3, drawn(3.5, 0.12), 4, 0.8),
          canvas.fractal<3>(4, drawn(7, 0.35), 2, 0.7),
          canvas.fractal<3>(5, drawn(0.5, 0.08), 3),
          make_ramp("colours", colours)};
}

struct WoodShader {
  Trunk trunk;
  Cut cut;
  float width, height;
  bool fold_x, fold_y;

  /// Mirrored at half the width where the picture tiles: rings of a trunk do not repeat.
  GRAMLOOM_INLINE static Floats folded(Floats v, float length, bool fold) {
    return fold ? length * abs(fraction(v / length) - 0.5f) : v;
  }
  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<3> p = solid(q);
    const Floats x = folded(p.at[0], width, fold_x), y = p.at[1], z = p.at[2];
    Floats across = x + 7, along_face = z;  // quarter: the face goes through the axis
    if (cut == Cut::rift) {
      across = 0.7071f * (x + z) + 7;
      along_face = 0.7071f * (x - z) + 7;
    } else if (cut == Cut::flat) {
      across = fold_x ? x : x - 0.5f * width;
      along_face = z + 1.3f;
    } else if (cut == Cut::end) {
      across = fold_x ? x : x - 0.3f * width;
      along_face = fold_y ? folded(y, height, true) : y - 0.4f * height;
    }
    return trunk.at(sqrt(across * across + along_face * along_face), p);
  }
};

struct PlanksShader {
  Lattice<2> boards;
  float half_gap, footprint, variation, rings;
  Trunk trunk;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    // Boards of each column begin elsewhere: its own random shift along y.
    const Floats column = floor(p.at[0] * boards.frequency[0]);
    const Ints where[2] = {wrap(to_ints(column), boards.period[0]), Ints{}};
    const Floats shift = unit_float(ArithmeticHash{boards.seed}(where), 1);
    const GridCell cell = grid_cell(boards, {{p.at[0], p.at[1] + shift / boards.frequency[1]}});
    const Floats depth = depth_in_box(cell.x, cell.y, splat(cell.width / 2 - half_gap),
                                      splat(cell.height / 2 - half_gap), 0.01f);
    const Floats board = coverage(depth, footprint);

    // Some boards are sawn near the trunk's middle, others far from it.
    const Floats across = rings * (cell.x + 1.4f * (unit_float(cell.id, 1) - 0.5f));
    const Floats away = rings * (0.25f + 1.6f * square(unit_float(cell.id, 2)));
    const Point<3> own{{p.at[0] + 9 * unit_float(cell.id, 3), p.at[1] + 9 * unit_float(cell.id, 4),
                        20 * unit_float(cell.id, 5)}};
    Surface wood = trunk.at(sqrt(across * across + away * away), own);
    const Floats tone = 1 + variation * 0.6f * (unit_float(cell.id, 6) - 0.5f);
    const Floats rim = smoothstep(0, 0.03f, depth);
    const Rgb gap = splat({0.07f, 0.05f, 0.03f});
    return {mix(gap, wood.colour * tone, board),
            rim * (wood.height + 0.15f * (unit_float(cell.id, 7) - 0.5f)), 1 - board};
  }
};

struct BarkShader {
  Lattice<2> ridges;
  Warp<2> twist;
  float half_fissure, footprint;
  Fractal<2> flakes, grain, moss, cracks;
  Ramp ramp;
  Rgb fissure_colour;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Point<2> moved = warped(twist, p);
    const Cells ridge = cells(ridges, moved, 0.95f, 0.05f);
    const Floats depth = ridge.rounded / ridges.frequency[0] - half_fissure;
    const Floats fissure = 1 - smoothstep(-0.10f, 0.10f, depth);
    const Floats flake = unit_sum(flakes, moved);
    const Floats sand = unit_sum(grain, p);
    // Cross cracks part the ridges into scales.
    const Floats crack =
        smoothstep(0.80f, 0.95f, 1 - abs(unit_sum(cracks, moved)) * 2.2f) * (1 - fissure);
    const Floats dome = smoothstep(-0.12f, 0.30f, depth);
    // Bark splits off in layers: terraces of the height.
    const Floats rough = dome * 0.6f + 0.30f * flake + 0.06f * sand;
    const Floats terrace = floor(rough * 6) / 6 + smoothstep(0.55f, 1, fraction(rough * 6)) / 6;
    const Floats height = 0.12f + mix(rough, terrace, splat(0.6f)) - 0.22f * crack;
    const Floats tone =
        0.30f + 0.45f * dome + 0.55f * flake + 0.2f * (unit_float(ridge.id, 3) - 0.5f);
    const Rgb ridge_colour = colour_at(ramp, tone) * ((1 + 0.3f * sand) * (1 - 0.35f * crack));
    const Rgb grown = mix(ridge_colour, splat({0.38f, 0.40f, 0.25f}) * (1 + 0.5f * sand),
                          0.45f * dome * smoothstep(0.15f, 0.5f, unit_sum(moss, p)));
    return {mix(grown, fissure_colour, 0.85f * fissure), clamp(height), fissure};
  }
};

}  // namespace

Texture paint(const Wood& params, const Canvas& canvas) {
  const WoodShader shader{make_trunk(canvas, 1, params.sharpness, params.curl, params.grain,
                                     params.colours, params.cut == Cut::end),
                          params.cut,
                          canvas.width,
                          canvas.height,
                          canvas.wraps(0),
                          canvas.wraps(1)};
  return render(shader, canvas);
}

Texture paint(const Planks& params, const Canvas& canvas) {
  const PlanksShader shader{canvas.grid(1, 1, 1 / params.length),
                            static_cast<float>(params.gap / 2),
                            canvas.footprint(),
                            static_cast<float>(params.variation),
                            static_cast<float>(params.rings),
                            make_trunk(canvas, params.rings, params.sharpness, params.curl,
                                       params.grain, params.colours, false)};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

Texture paint(const Bark& params, const Canvas& canvas) {
  const double along = 1 / params.stretch;
  const BarkShader shader{canvas.lattice<2>(1, {1, along}),
                          canvas.warp<2>(2, 0.7, 4, 0.35),
                          static_cast<float>(params.fissure / 2),
                          canvas.footprint(),
                          canvas.fractal<2>(3, {3, 3 * along}, 5, 0.6),
                          canvas.fractal<2>(4, 12, 3, 0.8),
                          canvas.fractal<2>(5, 0.35, 5),
                          canvas.fractal<2>(6, {0.5, 1.6}, 3),
                          make_ramp("colours", params.colours),
                          splat(make_colour("fissure_colour", params.fissure_colour))};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

}  // namespace gramloom
