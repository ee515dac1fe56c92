#include "io/check_finite.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace gramloom {

namespace {

// The first value that is `bad`, with its place; "" when there is none.
std::string find_value(const Image& image, bool (*is_bad)(float)) {
  const auto bad = std::find_if(image.pixels.begin(), image.pixels.end(), is_bad);
  if (bad == image.pixels.end()) return "";
  const auto index = static_cast<std::size_t>(bad - image.pixels.begin());
  const auto pixel = index / static_cast<std::size_t>(image.channels);
  const auto width = static_cast<std::size_t>(image.width);
  return fmt::format("the value at x {}, y {}, channel {} is {}", pixel % width, pixel / width,
                     index % static_cast<std::size_t>(image.channels), *bad);
}

}  // namespace

void check_finite(const Image& image) {
  const std::string found = find_value(image, [](float value) { return !std::isfinite(value); });
  if (!found.empty()) throw Error("{}", found);
}

void check_no_data(const Image& image) {
  const std::string found = find_value(image, [](float value) { return std::abs(value) >= 1e30f; });
  if (!found.empty()) throw Error("{}, a mark for missing data: fill such places first", found);
}

}  // namespace gramloom
