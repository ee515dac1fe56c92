#include "signal/normal_colours.h"

#include <algorithm>

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

}  // namespace gramloom
