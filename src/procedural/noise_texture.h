#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "core/request.h"
#include "procedural/canvas.h"
#include "procedural/ramp.h"

namespace gramloom {

template <>
inline constexpr std::array<std::string_view, 2> enum_names<Curve>{"linear", "spline"};

enum class NoiseBasis { value_linear, value, gradient, improved };
template <>
inline constexpr std::array<std::string_view, 4> enum_names<NoiseBasis>{"value_linear", "value",
                                                                        "gradient", "improved"};
enum class NoiseSum { fractal, turbulence, ridged };
template <>
inline constexpr std::array<std::string_view, 3> enum_names<NoiseSum>{"fractal", "turbulence",
                                                                      "ridged"};

/// Lattice noise and its sums over octaves through a colour ramp: one octave is the basis itself.
struct Noise {
  static constexpr std::string_view name = "noise";
  static constexpr std::string_view summary = "lattice noise in one to four dimensions";
  NoiseBasis basis = NoiseBasis::improved;
  int dimensions = 2;
  NoiseSum sum = NoiseSum::fractal;
  int octaves = 6;
  double lacunarity = 2;
  double gain = 0.5;
  double warp = 0;
  double contrast = 1;
  int levels = 0;
  std::vector<double> colours{0, 0, 0, 1, 1, 1};
  std::vector<double> positions;
  Curve curve = Curve::linear;
  static constexpr auto fields() {
    return std::tuple{
        Field{"basis", &Noise::basis, "which lattice noise"},
        Field{"dimensions",
              &Noise::dimensions,
              "of the noise; a sequence of frames moves through "
              "the third, or through the fourth",
              "",
              {1, 4}},
        Field{"sum", &Noise::sum, "how octaves add up"},
        Field{"octaves", &Noise::octaves, "terms of the sum", "", {1, max_octaves}},
        Field{"lacunarity",
              &Noise::lacunarity,
              "frequency of an octave over the last one's",
              "",
              {1, 8}},
        Field{"gain", &Noise::gain, "amplitude of an octave over the last one's", "", {0, 1}},
        Field{"warp", &Noise::warp, "how far other noise moves each point", "features", {0, 16}},
        Field{"contrast", &Noise::contrast, "factor before the colour ramp", "", {0, 100}},
        Field{"levels",
              &Noise::levels,
              "colours are indexed: so many even steps of the ramp; 0 is smooth",
              "",
              {0, 256}},
        Field{"colours", &Noise::colours, "colour ramp from low to high", "r, g, b, …", {0, 1}},
        Field{"positions",
              &Noise::positions,
              "where the ramp's colours are, rising; none: evenly",
              "",
              {0, 1}},
        Field{"curve", &Noise::curve, "between the ramp's colours"}};
  }
};
Texture paint(const Noise& params, const Canvas& canvas);

enum class CellularFeature { first, second, difference, border, cells };
template <>
inline constexpr std::array<std::string_view, 5> enum_names<CellularFeature>{
    "first", "second", "difference", "border", "cells"};

/// Cellular noise (Worley 1996) through a colour ramp.
struct Cellular {
  static constexpr std::string_view name = "cellular";
  static constexpr std::string_view summary = "distances to scattered points, and their cells";
  static constexpr bool solid = false;
  CellularFeature feature = CellularFeature::first;
  double jitter = 1;
  std::vector<double> colours{0.02, 0.03, 0.07, 0.15, 0.35, 0.5, 0.95, 0.95, 0.85};
  static constexpr auto fields() {
    return std::tuple{
        Field{"feature", &Cellular::feature,
              "distance to the nearest or the second point, their "
              "difference, distance to the cell's border, or a random number a cell"},
        Field{"jitter",
              &Cellular::jitter,
              "0: points on a square grid; 1: anywhere in its cells",
              "",
              {0, 1}},
        Field{"colours", &Cellular::colours, "colour ramp from 0 to 1", "r, g, b, …", {0, 1}}};
  }
};
Texture paint(const Cellular& params, const Canvas& canvas);

}  // namespace gramloom
