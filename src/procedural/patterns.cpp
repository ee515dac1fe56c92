#include "procedural/patterns.h"

#include <algorithm>
#include <cmath>

#include "procedural/fractal.h"
#include "procedural/grid.h"
#include "procedural/ramp.h"
#include "procedural/render.h"

namespace gramloom {

namespace {

struct StripesShader {
  float kx, ky;
  float amount;
  Fractal<3> fractal;
  float softness;  // of the edge, in stripes
  Rgb first, second;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& p) const {
    Floats phase = kx * p.at[0] + ky * p.at[1];
    if (amount > 0) phase += amount * turbulence(fractal, solid(p));
    // Distance to the nearest edge, as a part of a stripe: a triangle wave with sin's sign.
    const Floats wave = 1 - abs(4 * fraction(phase + 0.25f) - 2);
    const Floats hard = clamp(0.5f + 0.5f * wave / softness);
    const Floats t = softness < 1 ? hard : 0.5f + 0.5f * sin_turns(phase);
    return {mix(second, first, t), t};
  }
};

struct CheckerboardShader {
  std::array<float, 3> frequency;
  std::array<float, 3> footprint;  // of a sample, in squares; at least a little
  Rgb first, second;

  // The box-filtered square wave, −1 to 1, along each axis; their product is the checkerboard's.
  GRAMLOOM_INLINE Surface operator()(const Point<4>& p) const {
    Floats product = splat(1);
    for (std::size_t d = 0; d < 3; ++d) {
      const Floats wave = 1 - abs(4 * fraction(0.5f * frequency[d] * p.at[d] + 0.25f) - 2);
      product *= clamp(wave / footprint[d], -1, 1);
    }
    return {mix(second, first, 0.5f + 0.5f * product)};
  }
};

struct HexagonsShader {
  Lattice<2> even, odd;
  float stretch;  // of y, so that hexagons are regular in these coordinates
  float half_joint, footprint, variation;
  Ramp ramp;
  Rgb joint_colour;
  Fractal<2> shade;

  // The nearest of two staggered grids of centres owns the point.
  GRAMLOOM_INLINE Surface operator()(const Point<4>& q) const {
    const Point<2> p = flat(q);
    const float width = 1 / even.frequency[0];
    const GridCell a = grid_cell(even, p);
    const Point<2> moved{{p.at[0] + 0.5f * width, p.at[1] + 0.5f / even.frequency[1]}};
    const GridCell b = grid_cell(odd, moved);
    const Floats ay = a.y * stretch, by = b.y * stretch;
    const Ints nearer = a.x * a.x + ay * ay < b.x * b.x + by * by;
    const Floats x = abs(select(nearer, a.x, b.x)), y = abs(select(nearer, ay, by));
    const Uints id = select(nearer, a.id, b.id);
    const Floats depth = 0.5f * width - max(x, 0.5f * x + 0.8660254f * y);
    const Floats tile = coverage(depth - half_joint, footprint);
    const Floats t = 0.5f + variation * (unit_float(id, 1) - 0.5f);
    const Floats tone = 1 + 0.08f / shade.total * fractal_sum(shade, p);
    const Floats bevel = smoothstep(0, 0.08f, depth - half_joint);
    return {mix(joint_colour, colour_at(ramp, t), tile) * tone, bevel, 1 - tile};
  }
};

struct DotsShader {
  Lattice<2> grid;
  float stagger, radius, jitter, variation, footprint;
  Ramp ramp;
  Rgb ground;

  GRAMLOOM_INLINE Surface operator()(const Point<4>& p) const {
    const GridCell cell = grid_cell(grid, flat(p), stagger);
    const Floats r = radius * (1 - variation * unit_float(cell.id, 1));
    const Floats room_x = jitter * (0.5f * cell.width - r),
                 room_y = jitter * (0.5f * cell.height - r);
    const Floats x = cell.x + room_x * (2 * unit_float(cell.id, 2) - 1);
    const Floats y = cell.y + room_y * (2 * unit_float(cell.id, 3) - 1);
    const Floats disc = coverage(r - sqrt(x * x + y * y), footprint);
    return {mix(ground, colour_at(ramp, unit_float(cell.id, 4)), disc), disc, disc};
  }
};

}  // namespace

Texture paint(const Stripes& params, const Canvas& canvas) {
  const auto kx = canvas.frequency(0, 1);
  const auto slanted = canvas.count(1, std::abs(params.slant)) / static_cast<double>(canvas.height);
  const double ky = params.slant == 0 ? 0 : std::copysign(slanted, params.slant);
  const float footprint =
      2 * canvas.step_x * static_cast<float>(kx) / static_cast<float>(canvas.samples);
  const StripesShader shader{
      static_cast<float>(kx),
      static_cast<float>(ky),
      static_cast<float>(params.turbulence),
      canvas.fractal<3>(1, 1, params.octaves),
      std::max(static_cast<float>(params.softness), std::min(footprint, 0.99f)),
      splat(make_colour("first", params.first)),
      splat(make_colour("second", params.second))};
  return render(shader, canvas);
}

Texture paint(const Checkerboard& params, const Canvas& canvas) {
  CheckerboardShader shader{{},
                            {},
                            splat(make_colour("first", params.first)),
                            splat(make_colour("second", params.second))};
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    shader.frequency[axis] = static_cast<float>(canvas.frequency(d, 1, 2));
    const float along =
        std::abs(canvas.right[axis]) * canvas.step_x + std::abs(canvas.down[axis]) * canvas.step_y;
    shader.footprint[axis] =
        std::max(1e-4f, along * shader.frequency[axis] / static_cast<float>(canvas.samples));
  }
  return render(shader, canvas);
}

Texture paint(const Hexagons& params, const Canvas& canvas) {
  const double rows = 1 / std::sqrt(3.0);
  const Lattice<2> even = canvas.grid(1, 1, rows);
  Lattice<2> odd = even;
  odd.seed = canvas.random.stream(2).bits();
  const float stretch = even.frequency[1] / even.frequency[0] * std::sqrt(3.0f);
  const HexagonsShader shader{even,
                              odd,
                              stretch,
                              static_cast<float>(params.joint / 2),
                              canvas.footprint(),
                              static_cast<float>(params.variation),
                              make_ramp("colours", params.colours),
                              splat(make_colour("joint_colour", params.joint_colour)),
                              canvas.fractal<2>(3, 6, 4)};
  Texture texture = render(shader, canvas, {.height = true, .mask = true});
  light_relief(texture, canvas, params.relief);
  return texture;
}

Texture paint(const Dots& params, const Canvas& canvas) {
  const DotsShader shader{canvas.grid(1, 1, 1, 1, params.stagger > 0 ? 2 : 1),
                          static_cast<float>(params.stagger),
                          static_cast<float>(params.radius),
                          static_cast<float>(params.jitter),
                          static_cast<float>(params.variation),
                          canvas.footprint(),
                          make_ramp("colours", params.colours),
                          splat(make_colour("ground", params.ground))};
  return render(shader, canvas, {.mask = true});
}

}  // namespace gramloom
