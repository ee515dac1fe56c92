#include "procedural/ramp.h"

#include "core/error.h"
#include "core/fields.h"

namespace gramloom {

std::array<float, 3> make_colour(std::string_view key, const std::vector<double>& colour) {
  if (colour.size() != 3)
    throw ConfigError("{}: a colour is three numbers r, g, b; here are {}", key, colour.size());
  return {static_cast<float>(colour[0]), static_cast<float>(colour[1]),
          static_cast<float>(colour[2])};
}

Ramp make_ramp(std::string_view key, const std::vector<double>& colours,
               const std::vector<double>& positions, Curve curve) {
  const std::size_t count = colours.size() / 3;
  if (count < 1 || count > Ramp::max_colours || colours.size() % 3 != 0)
    throw ConfigError("{}: a colour ramp is 1 to {} colours of three numbers; here are {} numbers",
                      key, Ramp::max_colours, colours.size());
  if (!positions.empty() && positions.size() != count)
    throw ConfigError("{}: {} colours have {} positions", key, count, positions.size());
  const auto position = [&](std::size_t k) {
    if (!positions.empty()) return positions[k];
    return count == 1 ? 0.0 : static_cast<double>(k) / static_cast<double>(count - 1);
  };
  // Catmull–Rom's tangent, for uneven positions; one-sided at the ends.
  const auto slope = [&](std::size_t k, std::size_t c) {
    const std::size_t before = k > 0 ? k - 1 : k, after = k + 1 < count ? k + 1 : k;
    return (colours[3 * after + c] - colours[3 * before + c]) /
           (position(after) - position(before));
  };

  Ramp ramp;
  ramp.first = make_colour(key, {colours[0], colours[1], colours[2]});
  ramp.segments = static_cast<int>(count - 1);
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const double length = position(k + 1) - position(k);
    if (!(length > 0)) throw ConfigError("{}: positions must rise", key);
    Ramp::Segment& s = ramp.segment[k];
    s.from = static_cast<float>(position(k));
    s.scale = static_cast<float>(1 / length);
    for (std::size_t c = 0; c < 3; ++c) {
      const double rise = colours[3 * (k + 1) + c] - colours[3 * k + c];
      s.rise[c] = static_cast<float>(rise);
      if (curve == Curve::linear) continue;
      // The cubic is the line plus what its end slopes differ from the line's.
      s.start_slope[c] = static_cast<float>(slope(k, c) * length - rise);
      s.end_slope[c] = static_cast<float>(slope(k + 1, c) * length - rise);
    }
  }
  return ramp;
}

}  // namespace gramloom
