#include "procedural/textile.h"

#include "procedural/cellular.h"
#include "procedural/ramp.h"
#include "procedural/render.h"

namespace gramloom {

namespace {

/// i modulo n, n a power of two, also for negative i.
GRAMLOOM_INLINE Ints low_bits(Ints i, int n) { return i & (n - 1); }

/// +1 where the thread of the column is on top, −1 where that of the row is.
GRAMLOOM_INLINE Floats on_top(Binding binding, Ints column, Ints row) {
  Ints over = low_bits(column + row, 2) == 0;
  if (binding == Binding::basket) over = low_bits((column >> 1) + (row >> 1), 2) == 0;
  if (binding == Binding::twill) over = low_bits(column + row, 4) < 3;
  return select(over, splat(1), splat(-1));
}

/// One set of threads at a point: across the thread in (−½, ½), along it in threads, and how high
/// it runs, −1 to 1.
struct Thread {
  Floats across, along, level;
  Uints id;
};

/// The threads of the columns, for x across and y along them; rows with the two exchanged.
GRAMLOOM_INLINE Thread thread_at(const Lattice<2>& grid, Binding binding, Floats x, Floats y,
                                 bool rows) {
  const Floats number = floor(x), crossing = floor(y);
  const Ints i = to_ints(number), j = to_ints(crossing);
  const auto level = [&](Ints k) __attribute__((always_inline)) {
    return rows ? -on_top(binding, k, i) : on_top(binding, i, k);
  };
  // From the middle of one crossing to the middle of the next.
  const Floats f = y - crossing;
  const Floats here = level(j);
  const Floats other = select(f < 0.5f, level(j - 1), level(j + 1));
  const Floats share = 0.5f * smoothstep(0, 0.5f, abs(f - 0.5f));  // ½ half way to the other
  Thread thread;
  thread.across = x - number - 0.5f;
  thread.along = y;
  thread.level = mix(here, other, share);
  const int axis = rows ? 1 : 0;
  thread.id = hash(Uints(wrap(i, grid.period[static_cast<std::size_t>(axis)])) * 0x9E3779B1u ^
                   (grid.seed + static_cast<std::uint32_t>(axis)));
  return thread;
}

struct WeaveShader {
  Lattice<2> grid;
  Binding binding;
  float half_strip;
  Fractal<2> along_fibres, across_fibres, stain;
  Rgb along, across;

  GRAMLOOM_INLINE Surface strip(const Thread& thread, const Rgb& colour, Floats fibre) const {
    const Floats from_edge = half_strip - abs(thread.across);
    const Floats inside = smoothstep(0, 0.03f, from_edge);
    const Floats bulge = 1 - square(thread.across / half_strip);
    const Floats height = inside * (0.42f + 0.13f * bulge + 0.36f * thread.level + 0.04f * fibre);
    const Floats tone = (0.80f + 0.30f * unit_float(thread.id, 1)) * (1 + 0.40f * fibre) *
                        (0.8f + 0.2f * smoothstep(0, 0.12f, from_edge));
    return {colour * tone, height, inside};
  }
  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Floats x = p.at[0] * grid.frequency[0], y = p.at[1] * grid.frequency[1];
    const Surface a =
        strip(thread_at(grid, binding, x, y, false), along, unit_sum(along_fibres, p));
    const Surface b =
        strip(thread_at(grid, binding, y, x, true), across, unit_sum(across_fibres, p));
    const Floats a_on_top = smoothstep(-0.02f, 0.02f, a.height - b.height);
    const Floats height = max(max(a.height, b.height), 0.0f);
    const Rgb ground = splat({0.10f, 0.07f, 0.04f});
    const Rgb top =
        mix(b.colour, a.colour, a_on_top) * (0.62f + 0.38f * smoothstep(0.1f, 0.75f, height));
    return {mix(ground, top, smoothstep(0.0f, 0.06f, height)) * (1 + 0.15f * unit_sum(stain, p)),
            height, a_on_top};
  }
};

struct ClothShader {
  Lattice<2> grid;
  Binding binding;
  float half_yarn, fuzz, fading;
  Warp<2> crooked;
  Fractal<2> warp_fibres, weft_fibres, dye;
  Rgb warp_colour, weft_colour;

  GRAMLOOM_INLINE Surface yarn(const Thread& thread, const Rgb& colour, Floats fibre) const {
    const Floats inside = clamp(1 - square(thread.across / half_yarn));
    // Plies twisted around each other show as slanted ridges.
    const Floats twist =
        sin_turns(1.5f * thread.along + 0.9f * thread.across + unit_float(thread.id, 2));
    const Floats height = sqrt(inside) * 0.42f + 0.14f + 0.30f * thread.level +
                          0.05f * twist * inside + 0.14f * fuzz * fibre;
    const Floats tone =
        (0.86f + 0.22f * unit_float(thread.id, 1)) * (1 + 0.10f * twist + 0.55f * fuzz * fibre);
    return {colour * tone, height, inside};
  }
  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Point<2> moved = warped(crooked, p);
    const Floats x = moved.at[0] * grid.frequency[0], y = moved.at[1] * grid.frequency[1];
    const Floats faded = fading * smoothstep(-0.3f, 0.5f, unit_sum(dye, p));
    const Rgb dyed = mix(warp_colour, weft_colour, 0.35f * faded);
    const Surface a = yarn(thread_at(grid, binding, x, y, false), dyed, unit_sum(warp_fibres, p));
    const Surface b =
        yarn(thread_at(grid, binding, y, x, true), weft_colour, unit_sum(weft_fibres, p));
    const Floats warp_on_top = smoothstep(-0.03f, 0.03f, a.height - b.height);
    const Floats height = clamp(max(a.height, b.height));
    return {mix(b.colour, a.colour, warp_on_top) * (0.55f + 0.55f * height), height, warp_on_top};
  }
};

struct LeatherShader {
  Lattice<2> grains, fine;
  Warp<2> pull;
  float half_crease;
  Fractal<2> dye, pores;
  Ramp ramp;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const Point<2> moved = warped(pull, p);
    const Cells grain = cells(grains, moved, 0.85f, 0.12f);
    const Cells small = cells(fine, moved, 0.9f, 0.10f);
    const Floats depth = grain.rounded / grains.frequency[0] - half_crease;
    const Floats dome = smoothstep(-0.16f, 0.20f, depth);
    const Floats little = smoothstep(-0.05f, 0.25f, small.rounded);
    const Floats pore = unit_sum(pores, p);
    const Floats height = 0.08f + 0.62f * dome + 0.16f * little + 0.08f * pore +
                          0.10f * (unit_float(grain.id, 3) - 0.5f) * dome;
    const Floats tone = 0.20f + 0.48f * dome + 0.16f * little + 0.30f * unit_sum(dye, p) +
                        0.10f * (unit_float(grain.id, 4) - 0.5f);
    return {colour_at(ramp, tone) * (1 + 0.10f * pore), clamp(height), 1 - dome};
  }
};

int threads_a_repeat(Binding binding) { return binding == Binding::plain ? 2 : 4; }

}  // namespace

Texture paint(const Weave& params, const Canvas& canvas) {
  const int repeat = threads_a_repeat(params.binding);
  const WeaveShader shader{
      canvas.grid(1, 1, 1, repeat, repeat),      params.binding,
      static_cast<float>(params.strip / 2),      canvas.fractal<2>(2, {6, 0.4}, 4, 0.7),
      canvas.fractal<2>(3, {0.4, 6}, 4, 0.7),    canvas.fractal<2>(4, 0.4, 4),
      splat(make_colour("along", params.along)), splat(make_colour("across", params.across))};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

Texture paint(const Cloth& params, const Canvas& canvas) {
  const int repeat = threads_a_repeat(params.binding);
  const ClothShader shader{canvas.grid(1, 1, 1, repeat, repeat),
                           params.binding,
                           static_cast<float>(params.yarn / 2),
                           static_cast<float>(params.fuzz),
                           static_cast<float>(params.fading),
                           canvas.warp<2>(2, 0.6, 3, 0.25 * params.fuzz),
                           canvas.fractal<2>(3, {4, 1.2}, 3, 0.8),
                           canvas.fractal<2>(4, {1.2, 4}, 3, 0.8),
                           canvas.fractal<2>(5, {0.2, 0.08}, 5, 0.6),
                           splat(make_colour("warp_colour", params.warp_colour)),
                           splat(make_colour("weft_colour", params.weft_colour))};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

Texture paint(const Leather& params, const Canvas& canvas) {
  const LeatherShader shader{
      canvas.lattice<2>(1, {1, 1.25}),     canvas.lattice<2>(2, 3.1),
      canvas.warp<2>(3, 1.2, 3, 0.18),     static_cast<float>(params.crease / 2),
      canvas.fractal<2>(4, 0.35, 5),       canvas.fractal<2>(5, 9, 3, 0.8),
      make_ramp("colours", params.colours)};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

}  // namespace gramloom
