#include "io/check_finite.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace gramloom {

namespace {

// The first value that is `bad`, with its place; "" when there is none.
std::string find_value(const float* values, std::size_t count, int width, int channels,
                       int first_row, bool (*is_bad)(float)) {
  const float* const bad = std::find_if(values, values + count, is_bad);
  if (bad == values + count) return "";
  const auto index = static_cast<std::size_t>(bad - values);
  const auto pixel = index / static_cast<std::size_t>(channels);
  const auto row = static_cast<std::size_t>(width);
  return fmt::format("the value at x {}, y {}, channel {} is {}", pixel % row,
                     pixel / row + static_cast<std::size_t>(first_row),
                     index % static_cast<std::size_t>(channels), *bad);
}

}  // namespace

void check_finite(const float* values, std::size_t count, int width, int channels, int first_row) {
  const std::string found = find_value(values, count, width, channels, first_row,
                                       [](float value) { return !std::isfinite(value); });
  if (!found.empty()) throw Error("{}", found);
}

void check_finite(const Image& image) {
  check_finite(image.pixels.data(), image.pixels.size(), image.width, image.channels, 0);
}

void check_no_data(const Image& image) {
  const std::string found =
      find_value(image.pixels.data(), image.pixels.size(), image.width, image.channels, 0,
                 [](float value) { return std::abs(value) >= 1e30f; });
  if (!found.empty()) throw Error("{}, a mark for missing data: fill such places first", found);
}

}  // namespace gramloom
