#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "procedural/pack.h"

namespace gramloom {

struct Rgb {
  Floats r, g, b;
};
GRAMLOOM_INLINE Rgb operator*(const Rgb& c, Floats f) { return {c.r * f, c.g * f, c.b * f}; }
GRAMLOOM_INLINE Rgb operator+(const Rgb& a, const Rgb& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
GRAMLOOM_INLINE Rgb mix(const Rgb& a, const Rgb& b, Floats t) {
  return {mix(a.r, b.r, t), mix(a.g, b.g, t), mix(a.b, b.b, t)};
}
GRAMLOOM_INLINE Rgb select(Ints mask, const Rgb& a, const Rgb& b) {
  return {select(mask, a.r, b.r), select(mask, a.g, b.g), select(mask, a.b, b.b)};
}

/// How a colour ramp passes through its colours.
enum class Curve { linear, spline };

/// Colours at positions in [0, 1], with what is between them: straight lines, or a cubic spline
/// through them (Catmull–Rom: each tangent from the neighbours). Constant beyond the ends.
struct Ramp {
  static constexpr int max_colours = 16;
  struct Segment {
    float from, scale;                                  // position, 1/length
    std::array<float, 3> rise, start_slope, end_slope;  // slopes per segment
  };
  std::array<float, 3> first{};
  int segments = 0;
  std::array<Segment, max_colours - 1> segment{};
};

/// A ramp from r, g, b, r, g, b, … at evenly spaced positions, or at `positions`, which rise from
/// first to last. Throws ConfigError naming `key` when there are not 1 to 16 whole colours, or
/// positions that don't fit them.
Ramp make_ramp(std::string_view key, const std::vector<double>& colours,
               const std::vector<double>& positions = {}, Curve curve = Curve::linear);

/// One colour. Throws ConfigError naming `key` unless there are three numbers.
std::array<float, 3> make_colour(std::string_view key, const std::vector<double>& colour);

GRAMLOOM_INLINE Rgb splat(const std::array<float, 3>& c) {
  return {splat(c[0]), splat(c[1]), splat(c[2])};
}

/// The ramp's colour at t. A sum over all segments of what each has risen up to t, so that no lane
/// needs a branch or a look-up.
GRAMLOOM_INLINE Rgb colour_at(const Ramp& ramp, Floats t) {
  Rgb colour = splat(ramp.first);
  for (std::size_t k = 0; k < static_cast<std::size_t>(ramp.segments); ++k) {
    const Ramp::Segment& s = ramp.segment[k];
    const Floats u = clamp((t - s.from) * s.scale);
    const Floats bulge = u * (1 - u);
    const Floats start = bulge * (1 - u), end = bulge * u;  // Hermite's basis: zero at both ends
    const auto channel = [&](std::size_t c) __attribute__((always_inline)) {
      return u * s.rise[c] + start * s.start_slope[c] - end * s.end_slope[c];
    };
    colour = colour + Rgb{channel(0), channel(1), channel(2)};
  }
  return colour;
}

}  // namespace gramloom
