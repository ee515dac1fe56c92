#include "classic/known_pixels.h"

#include <algorithm>

namespace gramloom {

void keep_known(Image& image, const Target& target) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < target.mask.pixels.size(); ++i)
    if (target.mask.pixels[i] <= 0.5f)
      std::copy_n(target.known.pixels.data() + i * channels, channels,
                  image.pixels.data() + i * channels);
}

}  // namespace gramloom
