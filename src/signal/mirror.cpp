#include "signal/mirror.h"

#include <algorithm>

namespace gramloom {

int mirrored(int i, int length) {
  i %= 2 * length;
  return i < length ? i : 2 * length - 1 - i;
}

Image at_least(const Image& image, int side) {
  Image result(std::max(image.width, side), std::max(image.height, side), image.channels);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      std::copy_n(image.at(mirrored(x, image.width), mirrored(y, image.height)), image.channels,
                  result.at(x, y));
  return result;
}

}  // namespace gramloom
