#include "procedural/masonry.h"

#include "procedural/cellular.h"
#include "procedural/grid.h"
#include "procedural/ramp.h"
#include "procedural/render.h"

namespace gramloom {

namespace {

struct TilesShader {
  Lattice<2> grid;
  float half_grout, bevel, marbling, variation, footprint;
  Fractal<2> clouds, grain;
  Ramp ramp;
  Rgb grout_colour;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const GridCell cell = grid_cell(grid, p);
    const Floats depth = depth_in_box(cell.x, cell.y, splat(cell.width / 2 - half_grout),
                                      splat(cell.height / 2 - half_grout), 0.5f * bevel);
    const Floats tile = coverage(depth, footprint);
    // Each tile is cut from another place of the same clay.
    const Point<2> clay{
        {p.at[0] + 9 * unit_float(cell.id, 1), p.at[1] + 9 * unit_float(cell.id, 2)}};
    const Floats cloud = unit_sum(clouds, clay);
    const Floats rough = unit_sum(grain, p);
    const Floats tone = 0.55f + variation * (unit_float(cell.id, 3) - 0.5f) + marbling * cloud;
    const Rgb glaze = colour_at(ramp, tone) * (1 + 0.10f * rough);
    const Floats rim = smoothstep(0, bevel, depth);
    const Floats tilt =
        (unit_float(cell.id, 4) - 0.5f) * cell.x + (unit_float(cell.id, 5) - 0.5f) * cell.y;
    const Floats top = 0.85f + 0.15f * tilt + 0.03f * cloud;
    const Floats bottom = 0.2f + 0.15f * rough;
    return {mix(grout_colour * (0.92f + 0.35f * rough), glaze, tile), mix(bottom, top, rim),
            1 - tile};
  }
};

struct BrickShader {
  Lattice<2> grid;
  float shift, half_mortar, wear, variation, footprint;
  Warp<2> crooked;
  Fractal<2> clay, pits, sand, stain;
  Ramp ramp;
  Rgb mortar_colour;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const GridCell cell = grid_cell(grid, warped(crooked, p), shift);
    const Floats shrink = wear * 0.02f * unit_float(cell.id, 1);
    const Floats depth = depth_in_box(cell.x, cell.y, cell.width / 2 - half_mortar - shrink,
                                      cell.height / 2 - half_mortar - 0.5f * shrink, 0.02f);
    const Floats brick = coverage(depth, footprint);

    const Point<2> own{
        {p.at[0] + 9 * unit_float(cell.id, 2), p.at[1] + 9 * unit_float(cell.id, 3)}};
    const Floats mottle = unit_sum(clay, own);
    const Floats pit = wear * smoothstep(0.22f, 0.42f, unit_sum(pits, own));
    const Floats grain = unit_sum(sand, p);
    const Floats dirt = wear * smoothstep(0.0f, 0.5f, unit_sum(stain, p));

    const Floats tone = 0.5f + variation * (unit_float(cell.id, 4) - 0.5f) + 0.35f * mottle;
    const Floats bright = (0.94f + 0.22f * variation * (unit_float(cell.id, 5) - 0.5f)) *
                          (1 + 0.22f * grain) * (1 - 0.35f * pit) * (1 - 0.25f * dirt);
    const Rgb face = colour_at(ramp, tone) * bright;
    const Rgb joint = mortar_colour * ((0.95f + 0.4f * grain) * (1 - 0.2f * dirt));

    const Floats tilt =
        (unit_float(cell.id, 6) - 0.5f) * cell.x + (unit_float(cell.id, 7) - 0.5f) * cell.y;
    const Floats top = 0.8f + 0.25f * tilt + 0.1f * mottle + 0.09f * grain - 0.3f * pit;
    const Floats bottom = 0.28f + 0.22f * grain;
    return {mix(joint, face, brick), mix(bottom, top, smoothstep(-0.005f, 0.035f, depth)),
            1 - brick};
  }
};

struct StoneWallShader {
  Lattice<2> lattice;
  float half_mortar, rounding, footprint;
  Warp<2> rough;
  Fractal<2> chips, grain, layers;
  Ramp ramp;
  Rgb mortar_colour;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Cells cell = cells(lattice, warped(rough, p), 0.85f, rounding);
    const Floats depth = cell.rounded / lattice.frequency[0] - half_mortar;
    const Floats stone = coverage(depth, footprint);
    const Point<2> own{
        {p.at[0] + 9 * unit_float(cell.id, 3), p.at[1] + 9 * unit_float(cell.id, 4)}};
    const Floats chip = unit_sum(chips, own);
    const Floats sand = unit_sum(grain, p);
    const Floats bands = unit_sum(layers, own);
    const Floats tone = unit_float(cell.id, 5) + 0.35f * bands + 0.2f * chip;
    const Rgb face = colour_at(ramp, tone) *
                     ((0.85f + 0.3f * unit_float(cell.id, 6)) * (1 + 0.35f * sand + 0.15f * chip));
    const Rgb joint = mortar_colour * (0.9f + 0.5f * sand);
    const Floats dome = 1 - square(1 - clamp(depth * 5.0f));
    const Floats top = 0.4f + 0.35f * dome + 0.28f * chip + 0.10f * bands + 0.05f * sand +
                       0.12f * (unit_float(cell.id, 7) - 0.5f);
    const Floats bottom = 0.2f + 0.2f * sand;
    return {mix(joint, face, stone), mix(bottom, top, smoothstep(-0.01f, 0.05f, depth)), 1 - stone};
  }
};

}  // namespace

Texture paint(const Tiles& params, const Canvas& canvas) {
  const TilesShader shader{canvas.grid(1, 1, 1),
                           static_cast<float>(params.grout / 2),
                           static_cast<float>(params.bevel),
                           static_cast<float>(params.marbling),
                           static_cast<float>(params.variation),
                           canvas.footprint(),
                           canvas.fractal<2>(2, 2.5, 5, 0.6),
                           canvas.fractal<2>(3, 12, 3, 0.7),
                           make_ramp("colours", params.colours),
                           splat(make_colour("grout_colour", params.grout_colour))};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

Texture paint(const Brick& params, const Canvas& canvas) {
  const BrickShader shader{canvas.grid(1, 1, params.aspect, 1, 2),
                           static_cast<float>(params.shift),
                           static_cast<float>(params.mortar / 2),
                           static_cast<float>(params.wear),
                           static_cast<float>(params.variation),
                           canvas.footprint(),
                           canvas.warp<2>(2, 4, 3, 0.035 * params.wear),
                           canvas.fractal<2>(3, 4, 5, 0.6),
                           canvas.fractal<2>(4, 9, 3, 0.6),
                           canvas.fractal<2>(5, 16, 3, 0.8),
                           canvas.fractal<2>(6, 0.6, 5),
                           make_ramp("colours", params.colours),
                           splat(make_colour("mortar_colour", params.mortar_colour))};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

Texture paint(const StoneWall& params, const Canvas& canvas) {
  const StoneWallShader shader{canvas.lattice<2>(1, {1, params.flatness}),
                               static_cast<float>(params.mortar / 2),
                               static_cast<float>(params.roundness),
                               canvas.footprint(),
                               canvas.warp<2>(2, 2.5, 4, 0.12),
                               canvas.fractal<2>(3, 2.5, 5, 0.6),
                               canvas.fractal<2>(4, 14, 3, 0.8),
                               canvas.fractal<2>(5, {1.2, 5}, 3),
                               make_ramp("colours", params.colours),
                               splat(make_colour("mortar_colour", params.mortar_colour))};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

}  // namespace gramloom
