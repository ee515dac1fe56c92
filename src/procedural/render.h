#pragma once

#include <algorithm>
#include <string>

#include "core/request.h"
#include "core/threads.h"
#include "procedural/canvas.h"
#include "procedural/ramp.h"

namespace gramloom {

/// What a texture is at a point. Height and mask are in [0, 1].
struct Surface {
  Rgb colour;
  Floats height = Floats{};
  Floats mask = Floats{};
};

/// Which maps a texture has beside its colour.
struct Maps {
  bool height = false;
  bool mask = false;
};

GRAMLOOM_INLINE Point<2> flat(const Point<4>& p) { return {{p.at[0], p.at[1]}}; }
GRAMLOOM_INLINE Point<3> solid(const Point<4>& p) { return {{p.at[0], p.at[1], p.at[2]}}; }

namespace detail {

GRAMLOOM_INLINE void store_colour(const Rgb& colour, float* to, int count) {
  float r[pack_size], g[pack_size], b[pack_size];
  store(colour.r, r);
  store(colour.g, g);
  store(colour.b, b);
  for (int lane = 0; lane < count; ++lane) {
    to[3 * lane] = r[lane];
    to[3 * lane + 1] = g[lane];
    to[3 * lane + 2] = b[lane];
  }
}

/// One row of the picture: the mean over each pixel's grid of samples (a box filter).
template <class Shader>
GRAMLOOM_SIMD void render_row(const Shader& shader, const Canvas& canvas, int y, float* colour,
                              float* height, float* mask) {
  const int n = canvas.samples;
  const float weight = 1 / static_cast<float>(n * n);
  for (int x = 0; x < canvas.size.width; x += pack_size) {
    Surface sum{};
    for (int sy = 0; sy < n; ++sy) {
      const float v =
          (static_cast<float>(y) + (static_cast<float>(sy) + 0.5f) / static_cast<float>(n)) *
          canvas.step_y;
      for (int sx = 0; sx < n; ++sx) {
        const Floats u = (static_cast<float>(x) + lane_numbers() +
                          (static_cast<float>(sx) + 0.5f) / static_cast<float>(n)) *
                         canvas.step_x;
        Point<4> p;
        for (std::size_t d = 0; d < 4; ++d)
          p.at[d] = canvas.origin[d] + u * canvas.right[d] + v * canvas.down[d];
        const Surface s = shader(p);
        sum.colour = sum.colour + s.colour;
        sum.height += s.height;
        sum.mask += s.mask;
      }
    }
    const int count = std::min(pack_size, canvas.size.width - x);
    const auto level = [&](Floats v) __attribute__((always_inline)) { return clamp(v * weight); };
    store_colour({level(sum.colour.r), level(sum.colour.g), level(sum.colour.b)}, colour + 3 * x,
                 count);
    if (height) store(level(sum.height), height + x, count);
    if (mask) store(level(sum.mask), mask + x, count);
  }
}

/// The canvas's points [first, first + count), as many as a pack holds; the last one fills it up.
inline Point<4> points_at(const Canvas& canvas, int first, int count) {
  Point<4> p;
  for (int lane = 0; lane < pack_size; ++lane) {
    const auto& point = canvas.points[static_cast<std::size_t>(first + std::min(lane, count - 1))];
    for (std::size_t d = 0; d < 3; ++d) p.at[d][lane] = canvas.origin[d] + point[d];
  }
  p.at[3] = Floats{};
  return p;
}

/// The colours at the canvas's points.
template <class Shader>
GRAMLOOM_SIMD void render_points(const Shader& shader, const Canvas& canvas, float* colour) {
  const int all = static_cast<int>(canvas.points.size());
  for (int x = 0; x < all; x += pack_size) {
    const int count = std::min(pack_size, all - x);
    const Rgb c = shader(points_at(canvas, x, count)).colour;
    store_colour({clamp(c.r), clamp(c.g), clamp(c.b)}, colour + 3 * x, count);
  }
}

}  // namespace detail

/// Evaluates `shader`, a function object Surface(const Point<4>&), on the canvas.
template <class Shader>
Texture render(const Shader& shader, const Canvas& canvas, Maps maps = {}) {
  Texture texture{Image(canvas.size, 3), {}};
  if (!canvas.points.empty()) {
    detail::render_points(shader, canvas, texture.image.pixels.data());
    return texture;
  }
  float* height = nullptr;
  float* mask = nullptr;
  if (maps.height) height = (texture.maps["height"] = Image(canvas.size, 1)).pixels.data();
  if (maps.mask) mask = (texture.maps["mask"] = Image(canvas.size, 1)).pixels.data();

  constexpr int rows_a_step = 64;
  for (int top = 0; top < canvas.size.height; top += rows_a_step) {
    canvas.control->step(top, canvas.size.height);
    const int rows = std::min(rows_a_step, canvas.size.height - top);
    parallel_for(rows, 1, [&](std::int64_t begin, std::int64_t end) {
      for (auto row = begin; row < end; ++row) {
        const int y = top + static_cast<int>(row);
        const std::int64_t first = std::int64_t{y} * canvas.size.width;
        detail::render_row(shader, canvas, y, texture.image.at(0, y),
                           height ? height + first : nullptr, mask ? mask + first : nullptr);
      }
    });
  }
  canvas.control->step(canvas.size.height, canvas.size.height);
  return texture;
}

/// Bakes the light into the colour: `relief` is how far apart, in features, the heights 0 and 1
/// are. The slopes facing the canvas's light become lighter, those turned away and the hollows
/// darker.
void light_relief(Texture& texture, const Canvas& canvas, double relief);

}  // namespace gramloom
