#include "surface/preview.h"

#include <algorithm>

#include "core/threads.h"
#include "surface/preview_scene.h"
#include "surface/shading.h"

namespace gramloom {

namespace {

constexpr int block_side = 16;

// Below 0.8 a value is itself, above it comes ever closer to 1.
float pressed(float value) {
  constexpr float knee = 0.8f, room = 1 - knee;
  return value <= knee ? value : knee + room * (1 - std::exp((knee - value) / room));
}

}  // namespace

Image linear_picture(const Image& picture) {
  Image linear = picture;
  for (float& value : linear.pixels) value = linear_from_srgb(value);
  return linear;
}

RenderedPreview render_preview(const PreviewParams& params,
                               std::span<const PreviewMaterial> materials, const Image& environment,
                               const Control& control) {
  const PreviewScene scene = make_scene(params, materials, environment);
  Image picture(params.size, 4);
  const int columns = (params.size.width + block_side - 1) / block_side;
  const int rows = (params.size.height + block_side - 1) / block_side;
  // A report after every few rows of blocks.
  constexpr int rows_a_step = 4;
  for (int first = 0; first < rows; first += rows_a_step) {
    control.step(first, rows);
    const int count = std::min(rows_a_step, rows - first) * columns;
    parallel_for(count, 1, [&](std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<int>(begin); i < end; ++i) {
        const int left = i % columns * block_side, top = (first + i / columns) * block_side;
        render_block(scene,
                     {left, top, std::min(left + block_side, params.size.width),
                      std::min(top + block_side, params.size.height)},
                     picture);
      }
    });
  }
  control.step(rows, rows);
  return {std::move(picture), scene.notes};
}

Cost estimate_preview(const PreviewParams& params, Size material) {
  constexpr double channels = 8, with_levels = 4.0 / 3, per_triangle = 250;  // values, ×, bytes
  const double picture = 1.0 * params.size.width * params.size.height;
  const double samples = picture * params.samples * params.samples;
  double texels = 1.0 * material.width * material.height;
  if (params.stochastic) texels *= 8;  // of a cover that repeats a few times
  // Edges of `detail` pixels, or the shortest that meshes have, over a ball.
  const double edge =
      std::max(2.6 * params.detail / std::min(params.size.width, params.size.height), 0.0045);
  const double triangles = params.displacement != 0 ? 30 / (edge * edge) : 1e4;
  const bool solid = params.mapping == Mapping::solid;
  return {16 * picture + per_triangle * triangles +
              (solid ? 0 : 4 * texels * channels * (1 + with_levels)),
          {.serial = 0.1,
           .shared = samples * (solid ? 1.2e-6 : 4e-7) + 1e-6 * triangles +
                     (solid ? 0 : 8e-9 * texels * channels)}};
}

Image shown_preview(const PreviewParams& params, const Image& rendered, Shown as) {
  const bool clear = params.background == Background::transparent;
  Image shown(rendered.size(), clear ? 4 : 3);
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x) {
      const float* from = rendered.at(x, y);
      float* to = shown.at(x, y);
      // Colours of ours are not multiplied by alpha.
      const float alpha = clear ? std::max(from[3], 1e-6f) : 1;
      for (int c = 0; c < 3; ++c)
        to[c] = as == Shown::light ? from[c] / alpha : srgb_from_linear(pressed(from[c] / alpha));
      if (clear) to[3] = from[3];
    }
  return shown;
}

}  // namespace gramloom
