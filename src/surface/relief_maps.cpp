#include "surface/relief_maps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/portable_math.h"
#include "core/threads.h"
#include "surface/grid.h"

namespace gramloom {

namespace {

// Where a ray looks: each pixel nearby, then ever further apart, as the horizon is ever lower.
std::vector<float> distances_up_to(int radius) {
  std::vector<float> distances;
  for (double d = 1; d < radius + 0.5; d = std::max(d + 1, d * 1.25))
    distances.push_back(static_cast<float>(d));
  return distances;
}

struct Offset {
  int x = 0, y = 0;
  float inverse_distance = 0;
};

// The pixels that a ray of each direction passes.
std::vector<std::vector<Offset>> rays(int radius, int directions) {
  std::vector<std::vector<Offset>> all;
  for (int d = 0; d < directions; ++d) {
    const double angle = 2 * portable::pi * (d + 0.5) / directions;
    std::vector<Offset> ray;
    for (const float distance : distances_up_to(radius)) {
      const int x =
          static_cast<int>(std::lround(static_cast<double>(distance) * portable::cos(angle)));
      const int y =
          static_cast<int>(std::lround(static_cast<double>(distance) * portable::sin(angle)));
      if (x == 0 && y == 0) continue;
      const auto squared = static_cast<float>(x) * static_cast<float>(x) +
                           static_cast<float>(y) * static_cast<float>(y);
      ray.push_back({x, y, 1 / std::sqrt(squared)});
    }
    all.push_back(std::move(ray));
  }
  return all;
}

}  // namespace

Image ambient_occlusion(const Image& height, double strength, int radius, int directions,
                        Tile wraps) {
  check_one_channel(height, "a height map");
  if (radius < 1) throw Error("radius = {}: allowed are 1 or more pixels", radius);
  if (directions < 1) throw Error("directions = {}: allowed are 1 or more", directions);
  const auto all = rays(radius, directions);
  const auto pixels_high = static_cast<float>(strength);
  Image seen(height.size(), 1);
  parallel_for(height.height, 4, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < height.width; ++x) {
        const float own = *height.at(x, y);
        float sum = 0;
        for (const auto& ray : all) {
          float horizon = 0;  // the tangent of its angle
          for (const Offset& offset : ray) {
            const float rise = *height.at(neighbour(x + offset.x, height.width, tiles_x(wraps)),
                                          neighbour(y + offset.y, height.height, tiles_y(wraps))) -
                               own;
            horizon = std::max(horizon, pixels_high * rise * offset.inverse_distance);
          }
          sum += 1 / (1 + horizon * horizon);  // cos²
        }
        *seen.at(x, y) = sum / static_cast<float>(directions);
      }
  });
  return seen;
}

Image curvature(const Image& height, double strength, double radius, Tile wraps) {
  check_one_channel(height, "a height map");
  if (!(radius > 0)) throw Error("radius = {}: allowed are numbers above 0", radius);
  const auto pixels_high = static_cast<float>(strength);
  const auto scale = static_cast<float>(radius);
  Image map(height.size(), 1);
  parallel_for(height.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < height.width; ++x) {
        const auto h = [&](int dx, int dy) {
          return pixels_high * *height.at(neighbour(x + dx, height.width, tiles_x(wraps)),
                                          neighbour(y + dy, height.height, tiles_y(wraps)));
        };
        const float centre = h(0, 0), left = h(-1, 0), right = h(1, 0), up = h(0, -1),
                    down = h(0, 1);
        const float hx = (right - left) / 2, hy = (down - up) / 2;
        const float hxx = left - 2 * centre + right, hyy = up - 2 * centre + down;
        const float hxy = (h(1, 1) - h(-1, 1) - h(1, -1) + h(-1, -1)) / 4;
        const float base = 1 + hx * hx + hy * hy;
        const float mean = ((1 + hy * hy) * hxx - 2 * hx * hy * hxy + (1 + hx * hx) * hyy) /
                           (2 * base * std::sqrt(base));
        *map.at(x, y) = std::clamp(0.5f - mean * scale / 2, 0.0f, 1.0f);
      }
  });
  return map;
}

}  // namespace gramloom
