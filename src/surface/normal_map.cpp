#include "surface/normal_map.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/threads.h"
#include "surface/relief.h"

namespace gramloom {

namespace {

constexpr std::int64_t rows_at_once = 16;

template <class F>
void for_each_row(int height, F&& row) {
  parallel_for(height, rows_at_once, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) row(y);
  });
}

}  // namespace

Image normals_from_height(const Image& height, double strength, Tile wraps) {
  check_height(height);
  Image normals(height.size(), 3);
  for_each_ground_row(height, strength, wraps, [&](int y, const GroundRows& rows) {
    float* to = normals.at(0, y);
    for (int x = 0; x < height.width; ++x) {
      const float along = (rows.here[x + 1] - rows.here[x - 1]) * 0.5f;
      // Rows count downwards and v upwards.
      const float up = (rows.above[x] - rows.below[x]) * 0.5f;
      const float inverse = 1 / std::sqrt(along * along + up * up + 1);
      to[3 * x] = -along * inverse;
      to[3 * x + 1] = -up * inverse;
      to[3 * x + 2] = inverse;
    }
  });
  return normals;
}

Image normals_to_colours(const Image& normals, GreenAxis green) {
  const float up = green == GreenAxis::up ? 1.0f : -1.0f;
  Image picture(normals.size(), 3);
  for_each_row(normals.height, [&](int y) {
    for (int x = 0; x < normals.width; ++x) {
      const float* n = normals.at(x, y);
      float* colour = picture.at(x, y);
      colour[0] = (n[0] + 1) / 2;
      colour[1] = (up * n[1] + 1) / 2;
      colour[2] = (n[2] + 1) / 2;
    }
  });
  return picture;
}

void make_unit(Image& picture, int first) {
  for_each_row(picture.height, [&](int y) {
    for (int x = 0; x < picture.width; ++x) make_unit(picture.at(x, y) + first);
  });
}

Image colours_to_normals(const Image& picture, GreenAxis green) {
  check_normal_map(picture);
  const bool components = is_signed(picture);
  const auto component = [components](float v) { return 2 * (components ? (v + 1) / 2 : v) - 1; };
  const float up = green == GreenAxis::up ? 1.0f : -1.0f;
  Image normals(picture.size(), 3);
  for_each_row(picture.height, [&](int y) {
    for (int x = 0; x < picture.width; ++x) {
      const float* colour = picture.at(x, y);
      store_unit(component(colour[0]), up * component(colour[1]), component(colour[2]),
                 normals.at(x, y));
    }
  });
  return normals;
}

}  // namespace gramloom
