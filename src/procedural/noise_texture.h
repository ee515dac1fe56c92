#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"

namespace gramloom {

enum class NoiseBasis { value, gradient, improved };
template <>
inline constexpr std::array<std::string_view, 3> enum_names<NoiseBasis>{"value", "gradient",
                                                                        "improved"};

/// Lattice noise as it is, or a fractal sum of it, through a colour ramp.
struct Noise {
  static constexpr std::string_view name = "noise";
  static constexpr std::string_view summary = "lattice noise and its fractal sums";
  NoiseBasis basis = NoiseBasis::improved;
  int octaves = 6;
  double lacunarity = 2;
  double gain = 0.5;
  std::vector<double> colours{0, 0, 0, 1, 1, 1};
  static constexpr auto fields() {
    return std::tuple{
        Field{"basis", &Noise::basis, "which lattice noise"},
        Field{"octaves", &Noise::octaves, "terms of the sum", "", {1, 16}},
        Field{"lacunarity", &Noise::lacunarity, "frequency of an octave over its last", "", {1, 8}},
        Field{"gain", &Noise::gain, "amplitude of an octave over its last", "", {0, 1}},
        Field{"colours", &Noise::colours, "colour ramp from low to high", "r, g, b, …", {0, 1}}};
  }
};

}  // namespace gramloom
