#include "classic/check_input.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace gramloom {

void check_input(const Image& exemplar, const Target& target) {
  constexpr int most_channels = 64;
  constexpr float largest_value = 1e15f;  // sums of squares of whole images stay finite
  if (exemplar.empty()) throw Error("the exemplar is empty");
  if (exemplar.channels > most_channels)
    throw Error("the exemplar has {} channels: allowed are 1 to {}", exemplar.channels,
                most_channels);
  if (!std::all_of(exemplar.pixels.begin(), exemplar.pixels.end(),
                   [](float v) { return std::isfinite(v); }))
    throw Error("the exemplar holds values that are not finite numbers");
  if (std::any_of(exemplar.pixels.begin(), exemplar.pixels.end(),
                  [](float v) { return std::abs(v) > largest_value; }))
    throw Error("the exemplar holds values beyond ±{:g}", largest_value);
  if (target.size.width < 1 || target.size.height < 1)
    throw Error("size = [{}, {}]: both must be at least 1", target.size.width, target.size.height);
}

}  // namespace gramloom
