#include "surface/relief_maps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/neighbour.h"
#include "core/portable_math.h"
#include "core/threads.h"
#include "signal/blur.h"
#include "surface/relief.h"

namespace gramloom {

namespace {

// Where a line looks: each pixel nearby, then ever further apart.
std::vector<double> distances_up_to(int radius) {
  std::vector<double> distances;
  for (double d = 1; d < radius + 0.5; d = std::max(d + 1, d * 1.125)) distances.push_back(d);
  return distances;
}

struct Step {
  int x = 0, y = 0;
  float inverse_distance = 0;
};

// A line through a point: its direction, and the pixels that it passes on one side; those of the
// other side lie opposite.
struct Line {
  float x = 0, y = 0;
  std::vector<Step> steps;
};

std::vector<Line> lines_through_a_point(int radius, int count) {
  std::vector<Line> lines;
  for (int i = 0; i < count; ++i) {
    const double angle = portable::pi * i / count;
    const double cos = portable::cos(angle), sin = portable::sin(angle);
    Line line{static_cast<float>(cos), static_cast<float>(sin), {}};
    for (const double distance : distances_up_to(radius)) {
      const auto x = static_cast<int>(std::lround(distance * cos));
      const auto y = static_cast<int>(std::lround(distance * sin));
      line.steps.push_back(
          {x, y, static_cast<float>(1 / portable::sqrt(1.0 * x * x + 1.0 * y * y))});
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

// A height map in pixels with a margin around it: what lies there on axes that wrap, else an abyss,
// which hides nothing.
struct Plateau {
  int margin;
  std::int64_t stride;
  std::vector<float> heights;

  const float* at(int x, int y) const {
    return heights.data() + (y + margin) * stride + x + margin;
  }
};

Plateau plateau_of(const Image& height, double strength, Tile wraps, int margin) {
  constexpr float abyss = -1e30f;
  const auto pixels_high = static_cast<float>(strength);
  Plateau plateau{margin, height.width + 2 * std::int64_t{margin}, {}};
  plateau.heights.assign(
      static_cast<std::size_t>(plateau.stride * (height.height + 2 * std::int64_t{margin})), abyss);
  parallel_for(height.height + 2 * margin, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      const int y = row - margin;
      if (!tiles_y(wraps) && (y < 0 || y >= height.height)) continue;
      const float* from = height.at(0, neighbour(y, height.height, true));
      float* to = plateau.heights.data() + row * plateau.stride + margin;
      const int aside = tiles_x(wraps) ? margin : 0;
      for (int x = -aside; x < 0; ++x) to[x] = pixels_high * from[neighbour(x, height.width, true)];
      for (int x = 0; x < height.width; ++x) to[x] = pixels_high * from[x];
      for (int x = height.width; x < height.width + aside; ++x)
        to[x] = pixels_high * from[neighbour(x, height.width, true)];
    }
  });
  return plateau;
}

// The arc tangent to 1e-5 (Abramowitz, Stegun 1964, 4.4.49 to fewer terms), without branches.
inline float arc_tangent(float t) {
  const float size = std::abs(t);
  const bool steep = size > 1;
  const float x = steep ? 1 / size : size;
  const float s = x * x;
  const float a =
      x * (0.9998660f + s * (-0.3302995f + s * (0.1801410f + s * (-0.0851330f + s * 0.0208351f))));
  const float angle = steep ? 1.57079633f - a : a;
  return t < 0 ? -angle : angle;
}

// Rows of a picture, each a value a pixel, for one row of points.
struct Horizons {
  std::vector<float> slope_x, slope_y;  // of the ground
  std::vector<float> ahead, behind;     // the tangents of a line's two horizons, less the slope
  std::vector<float> seen;              // sums over lines

  explicit Horizons(std::size_t width)
      : slope_x(width), slope_y(width), ahead(width), behind(width), seen(width) {}
};

// How far the horizons rise above the ground's own slope along the line. What is compared with a
// step's pixel is the tangent plane there, as pixels lie a little beside the line.
void look_along(const Line& line, const Plateau& plateau, int y, Horizons& row) {
  std::fill(row.ahead.begin(), row.ahead.end(), 0.0f);
  std::fill(row.behind.begin(), row.behind.end(), 0.0f);
  const float* here = plateau.at(0, y);
  for (const Step& step : line.steps) {
    const float* ahead = plateau.at(step.x, y + step.y);
    const float* behind = plateau.at(-step.x, y - step.y);
    const auto dx = static_cast<float>(step.x), dy = static_cast<float>(step.y);
    for (std::size_t x = 0; x < row.seen.size(); ++x) {
      const float plane = row.slope_x[x] * dx + row.slope_y[x] * dy;
      row.ahead[x] = std::max(row.ahead[x], (ahead[x] - here[x] - plane) * step.inverse_distance);
      row.behind[x] =
          std::max(row.behind[x], (behind[x] - here[x] + plane) * step.inverse_distance);
    }
  }
}

// Equation 7 with sin γ = −s c, cos γ = c = 1/√(1 + s²) for the slope s along the line, and the
// length √(1 + s²)/|N| of the normal's projection onto the line's plane.
void add_light_between_horizons(const Line& line, Horizons& row) {
  for (std::size_t x = 0; x < row.seen.size(); ++x) {
    const float p = row.slope_x[x], q = row.slope_y[x];
    const float s = line.x * p + line.y * q;
    const float a = s + row.ahead[x], b = row.behind[x] - s;
    const float cos2_a = 1 / (1 + a * a), cos2_b = 1 / (1 + b * b);
    const float turned = a * cos2_a - b * cos2_b + arc_tangent(a) - arc_tangent(b);
    row.seen[x] += 0.5f * (cos2_a + cos2_b + s * turned) / std::sqrt(1 + p * p + q * q);
  }
}

// A row's value at x, also beyond its ends: there the ground goes on as it came, turned by half
// around each end, so that a slope stays one.
float beyond_ends(const float* row, int width, int x) {
  const int last = width - 1;
  if (last == 0) return row[0];
  const int turns = static_cast<int>(std::floor(static_cast<double>(x) / (2 * last)));
  const int at = x - 2 * last * turns;
  const float climb = 2 * (row[last] - row[0]) * static_cast<float>(turns);
  return climb + (at <= last ? row[at] : 2 * row[last] - row[2 * last - at]);
}

// With `margin` more columns on either side.
Image with_margins(const Image& height, int margin) {
  Image wide(height.width + 2 * margin, height.height, 1);
  for (int y = 0; y < wide.height; ++y)
    for (int x = 0; x < wide.width; ++x)
      *wide.at(x, y) = beyond_ends(height.at(0, y), height.width, x - margin);
  return wide;
}

Image transposed(const Image& image) {
  Image other(image.height, image.width, 1);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) *other.at(y, x) = *image.at(x, y);
  return other;
}

// Weighted by a Gaussian, with the same ground beyond the edges as everywhere here.
Image smoothed(const Image& height, double scale, Tile wraps) {
  if (scale == 0) return height;
  const int margin = static_cast<int>(std::ceil(4 * scale)) + 1;
  const int across = tiles_x(wraps) ? 0 : margin, down = tiles_y(wraps) ? 0 : margin;
  const Image wide = transposed(with_margins(height, across));
  const Image blur = blurred(transposed(with_margins(wide, down)), scale, wraps);
  Image smooth(height.size(), 1);
  for (int y = 0; y < height.height; ++y)
    std::copy_n(blur.at(across, y + down), height.width, smooth.at(0, y));
  return smooth;
}

}  // namespace

Image ambient_occlusion(const Image& height, double strength, int radius, int lines, Tile wraps) {
  check_height(height);
  if (radius < 1) throw Error("radius = {}: allowed are 1 or more pixels", radius);
  if (lines < 1) throw Error("lines = {}: allowed are 1 or more", lines);
  const auto all = lines_through_a_point(radius, lines);
  const Plateau plateau = plateau_of(height, strength, wraps, radius + 1);
  Image seen(height.size(), 1);
  for_each_ground_row(height, strength, wraps, [&](int y, const GroundRows& ground) {
    Horizons row(static_cast<std::size_t>(height.width));
    for (int x = 0; x < height.width; ++x) {
      row.slope_x[static_cast<std::size_t>(x)] = (ground.here[x + 1] - ground.here[x - 1]) / 2;
      row.slope_y[static_cast<std::size_t>(x)] = (ground.below[x] - ground.above[x]) / 2;
    }
    for (const Line& line : all) {
      look_along(line, plateau, y, row);
      add_light_between_horizons(line, row);
    }
    for (int x = 0; x < height.width; ++x)
      *seen.at(x, y) =
          std::clamp(row.seen[static_cast<std::size_t>(x)] / static_cast<float>(lines), 0.0f, 1.0f);
  });
  return seen;
}

Image curvature(const Image& height, double strength, double radius, double scale, Tile wraps) {
  check_height(height);
  if (!(radius > 0)) throw Error("radius = {}: allowed are numbers above 0", radius);
  if (!(scale >= 0)) throw Error("scale = {}: allowed are numbers from 0", scale);
  const auto top = static_cast<float>(radius);
  const Image smooth = smoothed(height, scale, wraps);
  Image map(height.size(), 1);
  for_each_ground_row(smooth, strength, wraps, [&](int y, const GroundRows& ground) {
    const float *a = ground.above, *h = ground.here, *b = ground.below;
    for (int x = 0; x < height.width; ++x) {
      const float hx = (h[x + 1] - h[x - 1]) / 2, hy = (b[x] - a[x]) / 2;
      const float hxx = h[x - 1] - 2 * h[x] + h[x + 1], hyy = a[x] - 2 * h[x] + b[x];
      const float hxy = (b[x + 1] - b[x - 1] - a[x + 1] + a[x - 1]) / 4;
      const float base = 1 + hx * hx + hy * hy;
      const float mean = ((1 + hy * hy) * hxx - 2 * hx * hy * hxy + (1 + hx * hx) * hyy) /
                         (2 * base * std::sqrt(base));
      *map.at(x, y) = std::clamp(0.5f - mean * top / 2, 0.0f, 1.0f);
    }
  });
  return map;
}

}  // namespace gramloom
