#include "procedural/render.h"

#include <algorithm>
#include <array>

#include "core/threads.h"

namespace gramloom {

namespace {

struct ErasedShader {
  const void* shader;
  detail::Shade shade;
};

constexpr int block = 16;  // packs that are shaded at a time, so that they stay in the cache

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

/// The points of a block of pixels from (x, y) on: of each pixel the sample (sx, sy).
GRAMLOOM_SIMD void place_samples(const Canvas& canvas, int x, int y, int sx, int sy, int packs,
                                 Point<4>* points) {
  const auto samples = static_cast<float>(canvas.samples);
  const float v =
      (static_cast<float>(y) + (static_cast<float>(sy) + 0.5f) / samples) * canvas.step_y;
  for (int k = 0; k < packs; ++k) {
    const Floats u = (static_cast<float>(x + k * pack_size) + lane_numbers() +
                      (static_cast<float>(sx) + 0.5f) / samples) *
                     canvas.step_x;
    for (std::size_t d = 0; d < 4; ++d)
      points[k].at[d] = canvas.origin[d] + u * canvas.right[d] + v * canvas.down[d];
  }
}

GRAMLOOM_SIMD void add(const Surface* surfaces, int packs, Surface* sums) {
  for (int k = 0; k < packs; ++k) {
    sums[k].colour = sums[k].colour + surfaces[k].colour;
    sums[k].height += surfaces[k].height;
    sums[k].mask += surfaces[k].mask;
  }
}

/// Where a row of the picture goes; null where a map is not wanted.
struct Row {
  float* colour;
  float* height;
  float* mask;
};

/// The sums times `weight`, clamped to [0, 1], to the row's pixels from x to `width`.
GRAMLOOM_SIMD void store_surfaces(const Surface* sums, int packs, float weight, int x, int width,
                                  const Row& row) {
  const auto level = [&](Floats v) __attribute__((always_inline)) { return clamp(v * weight); };
  for (int k = 0; k < packs; ++k, x += pack_size) {
    const int count = std::min(pack_size, width - x);
    const Surface& sum = sums[k];
    store_colour({level(sum.colour.r), level(sum.colour.g), level(sum.colour.b)},
                 row.colour + 3 * x, count);
    if (row.height) store(level(sum.height), row.height + x, count);
    if (row.mask) store(level(sum.mask), row.mask + x, count);
  }
}

/// One row of the picture: the mean over each pixel's grid of samples (a box filter).
void render_row(const ErasedShader& shader, const Canvas& canvas, int y, const Row& row) {
  const int n = canvas.samples;
  const float weight = 1 / static_cast<float>(n * n);
  std::array<Point<4>, block> points;
  std::array<Surface, block> surfaces;
  for (int x = 0; x < canvas.size.width; x += block * pack_size) {
    const int packs = std::min(block, (canvas.size.width - x + pack_size - 1) / pack_size);
    std::array<Surface, block> sums{};
    for (int sy = 0; sy < n; ++sy)
      for (int sx = 0; sx < n; ++sx) {
        place_samples(canvas, x, y, sx, sy, packs, points.data());
        shader.shade(shader.shader, points.data(), packs, surfaces.data());
        add(surfaces.data(), packs, sums.data());
      }
    store_surfaces(sums.data(), packs, weight, x, canvas.size.width, row);
  }
}

/// The canvas's points [first, first + count), as many as a pack holds; the last one fills it up.
Point<4> points_at(const Canvas& canvas, int first, int count) {
  Point<4> p;
  for (int lane = 0; lane < pack_size; ++lane) {
    const auto& point = canvas.points[static_cast<std::size_t>(first + std::min(lane, count - 1))];
    for (std::size_t d = 0; d < 3; ++d) p.at[d][lane] = canvas.origin[d] + point[d];
  }
  p.at[3] = Floats{};
  return p;
}

/// The colours at the canvas's points.
void render_points(const ErasedShader& shader, const Canvas& canvas, float* colour) {
  const int all = static_cast<int>(canvas.points.size());
  for (int x = 0; x < all; x += pack_size) {
    const Point<4> p = points_at(canvas, x, std::min(pack_size, all - x));
    Surface surface;
    shader.shade(shader.shader, &p, 1, &surface);
    store_surfaces(&surface, 1, 1, x, all, {colour, nullptr, nullptr});
  }
}

}  // namespace

Texture detail::render(const void* shader, Shade shade, const Canvas& canvas, const Maps& maps) {
  const ErasedShader erased{shader, shade};
  Texture texture{Image(canvas.size, 3), {}};
  if (!canvas.points.empty()) {
    render_points(erased, canvas, texture.image.pixels.data());
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
        render_row(erased, canvas, y,
                   {texture.image.at(0, y), height ? height + first : nullptr,
                    mask ? mask + first : nullptr});
      }
    });
  }
  canvas.control->step(canvas.size.height, canvas.size.height);
  return texture;
}

}  // namespace gramloom
