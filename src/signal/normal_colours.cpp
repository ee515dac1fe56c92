#include "signal/normal_colours.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace gramloom {

void check_normal_map(const Image& normal_map) {
  if (normal_map.channels < 3)
    throw Error("a normal map has {} channels, allowed are 3 or more", normal_map.channels);
}

bool is_signed(const Image& normal_map) {
  return std::ranges::any_of(normal_map.pixels, [](float v) { return v < 0; });
}

Image as_colours(const Image& normal_map) {
  check_normal_map(normal_map);
  Image picture = normal_map;
  if (is_signed(normal_map))
    for (float& value : picture.pixels) value = (value + 1) / 2;
  return picture;
}

void store_unit(float x, float y, float z, float* to) {
  const float length = std::sqrt(x * x + y * y + z * z);
  if (length > 0) {
    to[0] = x / length;
    to[1] = y / length;
    to[2] = z / length;
  } else {
    to[0] = to[1] = 0;
    to[2] = 1;
  }
}

void make_unit(float* colour) {
  float n[3];
  store_unit(2 * colour[0] - 1, 2 * colour[1] - 1, 2 * colour[2] - 1, n);
  for (int c = 0; c < 3; ++c) colour[c] = (n[c] + 1) / 2;
}

}  // namespace gramloom
