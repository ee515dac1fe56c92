#include "io/check_finite.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace gramloom {

void check_finite(const Image& image) {
  const auto bad = std::find_if(image.pixels.begin(), image.pixels.end(),
                                [](float value) { return !std::isfinite(value); });
  if (bad == image.pixels.end()) return;
  const auto index = static_cast<std::size_t>(bad - image.pixels.begin());
  const auto pixel = index / static_cast<std::size_t>(image.channels);
  const auto width = static_cast<std::size_t>(image.width);
  throw Error("the value at x {}, y {}, channel {} is {}", pixel % width, pixel / width,
              index % static_cast<std::size_t>(image.channels), *bad);
}

}  // namespace gramloom
