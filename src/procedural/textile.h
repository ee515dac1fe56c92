#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "core/request.h"
#include "procedural/canvas.h"

namespace gramloom {

/// Which thread is on top where a column and a row cross.
enum class Binding { plain, basket, twill };
template <>
inline constexpr std::array<std::string_view, 3> enum_names<Binding>{"plain", "basket", "twill"};

/// Broad strips of cane, each a feature apart, over and under each other; mask: the strips along y.
struct Weave {
  static constexpr std::string_view name = "weave";
  static constexpr std::string_view summary = "basket work of flat strips";
  static constexpr bool solid = false;
  Binding binding = Binding::plain;
  double strip = 0.88;
  double relief = 0.30;
  std::vector<double> along{0.80, 0.62, 0.38};
  std::vector<double> across{0.66, 0.45, 0.24};
  static constexpr auto fields() {
    return std::tuple{
        Field{"binding", &Weave::binding, "how strips cross"},
        Field{"strip", &Weave::strip, "width of a strip", "features", {0.1, 1}},
        Field{"relief", &Weave::relief, "height of the strips, for the light", "features", {0, 1}},
        Field{"along", &Weave::along, "colour of the strips along y", "r, g, b", {0, 1}},
        Field{"across", &Weave::across, "colour of the strips along x", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Weave& params, const Canvas& canvas);

/// Twisted yarns, each a feature apart; mask: the yarns along y (the warp).
struct Cloth {
  static constexpr std::string_view name = "cloth";
  static constexpr std::string_view summary = "woven cloth of twisted yarns";
  static constexpr bool solid = false;
  Binding binding = Binding::twill;
  double yarn = 0.95;
  double fuzz = 0.5;
  double fading = 0.5;
  double relief = 0.45;
  std::vector<double> warp_colour{0.20, 0.30, 0.50};
  std::vector<double> weft_colour{0.72, 0.74, 0.76};
  static constexpr auto fields() {
    return std::tuple{
        Field{"binding", &Cloth::binding, "how yarns cross"},
        Field{"yarn", &Cloth::yarn, "width of a yarn", "features", {0.1, 1}},
        Field{"fuzz", &Cloth::fuzz, "how uneven the yarns are", "", {0, 1}},
        Field{"fading", &Cloth::fading, "of the dye, in patches", "", {0, 1}},
        Field{"relief", &Cloth::relief, "height of the yarns, for the light", "features", {0, 1}},
        Field{"warp_colour", &Cloth::warp_colour, "of the yarns along y", "r, g, b", {0, 1}},
        Field{"weft_colour", &Cloth::weft_colour, "of the yarns along x", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Cloth& params, const Canvas& canvas);

/// Leather: grains of a feature in irregular rows with creases between.
struct Leather {
  static constexpr std::string_view name = "leather";
  static constexpr std::string_view summary = "grained leather";
  static constexpr bool solid = false;
  double crease = 0.03;
  double relief = 0.10;
  std::vector<double> colours{0.26, 0.13, 0.07, 0.45, 0.25, 0.14, 0.55, 0.33, 0.20};
  static constexpr auto fields() {
    return std::tuple{
        Field{"crease", &Leather::crease, "width of the creases", "features", {0, 0.4}},
        Field{
            "relief", &Leather::relief, "height of the grains, for the light", "features", {0, 1}},
        Field{"colours",
              &Leather::colours,
              "colour ramp from creases to grains",
              "r, g, b, …",
              {0, 1}}};
  }
};
Texture paint(const Leather& params, const Canvas& canvas);

}  // namespace gramloom
