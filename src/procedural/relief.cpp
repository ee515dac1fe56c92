#include <algorithm>
#include <cmath>
#include <vector>

#include "core/neighbour.h"
#include "core/threads.h"
#include "procedural/render.h"

namespace gramloom {

namespace {

/// The mean over 2·radius + 1 neighbours along x, written transposed: twice is a blur of both axes.
Image blur_transposed(const Image& image, int radius, bool wraps) {
  Image result(image.height, image.width, 1);
  parallel_for(image.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      const float* row = image.at(0, y);
      double sum = 0;
      for (int x = -radius; x <= radius; ++x)
        sum += static_cast<double>(row[neighbour(x, image.width, wraps)]);
      for (int x = 0; x < image.width; ++x) {
        *result.at(y, x) = static_cast<float>(sum / (2 * radius + 1));
        sum += static_cast<double>(row[neighbour(x + radius + 1, image.width, wraps)]) -
               static_cast<double>(row[neighbour(x - radius, image.width, wraps)]);
      }
    }
  });
  return result;
}

/// Close to a Gaussian blur: the box twice.
Image blur(const Image& image, int radius, Tile tile) {
  Image result = image;
  for (int pass = 0; pass < 2; ++pass) {
    result = blur_transposed(result, radius, tiles_x(tile));
    result = blur_transposed(result, radius, tiles_y(tile));
  }
  return result;
}

/// How much of the sky the surroundings hide, 0 to 1: how far each point lies below the mean
/// around it, over the size of the surroundings, at several sizes.
Image occlusion(const Image& height, const Canvas& canvas, double relief) {
  Image result(height.width, height.height, 1);
  for (const double radius : {0.04, 0.12, 0.3}) {  // features
    const int pixels =
        std::max(1, static_cast<int>(std::lround(radius / static_cast<double>(canvas.step_x))));
    if (pixels > std::min(height.width, height.height) / 2) continue;
    const Image mean = blur(height, pixels, canvas.tile);
    const auto slope = static_cast<float>(relief / radius);
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
      result.pixels[i] +=
          0.45f * std::clamp(slope * (mean.pixels[i] - height.pixels[i]), 0.0f, 1.0f);
  }
  return result;
}

}  // namespace

void light_relief(Texture& texture, const Canvas& canvas, double relief) {
  if (relief <= 0) return;
  const Image& height = texture.maps.at("height");
  const Image hidden = occlusion(height, canvas, relief);
  const auto slope_x = static_cast<float>(relief) / (2 * canvas.step_x);
  const auto slope_y = static_cast<float>(relief) / (2 * canvas.step_y);
  const auto [lx, ly, lz] = canvas.light;
  constexpr float sky = 0.35f;  // light from everywhere, which hollows lose

  parallel_for(height.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < height.width; ++x) {
        const auto at = [&](int dx, int dy) {
          return *height.at(neighbour(x + dx, height.width, tiles_x(canvas.tile)),
                            neighbour(y + dy, height.height, tiles_y(canvas.tile)));
        };
        const float nx = -slope_x * (at(1, 0) - at(-1, 0));
        const float ny = -slope_y * (at(0, 1) - at(0, -1));
        const float facing =
            std::max(0.0f, nx * lx + ny * ly + lz) / std::sqrt(nx * nx + ny * ny + 1);
        // A flat surface keeps its colour.
        const float light =
            (sky + (1 - sky) * facing / lz) * (1 - std::min(1.0f, *hidden.at(x, y)));
        for (int c = 0; c < 3; ++c)
          texture.image.at(x, y)[c] = std::clamp(texture.image.at(x, y)[c] * light, 0.0f, 1.0f);
      }
  });
}

}  // namespace gramloom
