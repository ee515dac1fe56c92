#pragma once

#include <algorithm>
#include <cstdint>

#include "core/image.h"
#include "core/random.h"

namespace gramloom {

/// Normal numbers of mean 0.5.
inline Image grain(Size size, int channels, std::uint64_t seed = 1, float deviation = 0.1f) {
  Random random(seed);
  Image image(size, channels);
  for (float& value : image.pixels) value = 0.5f + deviation * random.normal();
  return image;
}

/// The image around its torus from (left, top) on.
inline Image window(const Image& image, int left, int top, Size size) {
  Image result(size, image.channels);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      std::copy_n(image.at((left + x) % image.width, (top + y) % image.height), image.channels,
                  result.at(x, y));
  return result;
}

}  // namespace gramloom
