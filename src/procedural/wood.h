#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "core/request.h"
#include "procedural/canvas.h"

namespace gramloom {

/// How a board is sawn from the trunk: its face along a radius, along a tangent, half way between,
/// or across the trunk.
enum class Cut { quarter, flat, rift, end };
template <>
inline constexpr std::array<std::string_view, 4> enum_names<Cut>{"quarter", "flat", "rift", "end"};

/// One solid trunk whose axis is y and whose rings are a feature apart: R = √(x² + z²), late wood
/// where cos(R)ᵖᵒʷᵉʳ is large, rings bent by noise (curl), fibres and pores along the axis (grain).
struct Wood {
  static constexpr std::string_view name = "wood";
  static constexpr std::string_view summary = "rings and grain of a trunk, sawn in four ways";
  static constexpr bool solid = true;
  Cut cut = Cut::flat;
  double sharpness = 8;
  double curl = 0.5;
  double grain = 0.6;
  std::vector<double> colours{0.79, 0.58, 0.36, 0.72, 0.49, 0.28,
                              0.55, 0.33, 0.17, 0.42, 0.23, 0.11};
  static constexpr auto fields() {
    return std::tuple{
        Field{"cut", &Wood::cut, "how the board is sawn"},
        Field{"sharpness",
              &Wood::sharpness,
              "power of the rings' wave: larger is narrower late wood",
              "",
              {1, 64}},
        Field{"curl", &Wood::curl, "how far noise bends the rings", "features", {0, 8}},
        Field{"grain", &Wood::grain, "strength of fibres and pores", "", {0, 1}},
        Field{"colours",
              &Wood::colours,
              "colour ramp from early to late wood",
              "r, g, b, …",
              {0, 1}}};
  }
};
Texture paint(const Wood& params, const Canvas& canvas);

/// Boards of a feature's width along y, each sawn from elsewhere; mask: the gaps.
struct Planks {
  static constexpr std::string_view name = "planks";
  static constexpr std::string_view summary = "a floor of boards";
  static constexpr bool solid = false;
  double length = 5;
  double gap = 0.025;
  double rings = 5;
  double sharpness = 4;
  double curl = 0.6;
  double grain = 0.6;
  double variation = 0.5;
  double relief = 0.04;
  std::vector<double> colours{0.76, 0.56, 0.36, 0.68, 0.46, 0.27,
                              0.54, 0.34, 0.19, 0.43, 0.26, 0.14};
  static constexpr auto fields() {
    return std::tuple{
        Field{"length", &Planks::length, "of a board", "features", {1, 64}},
        Field{"gap", &Planks::gap, "between boards", "features", {0, 0.5}},
        Field{"rings", &Planks::rings, "across a board", "", {0.5, 64}},
        Field{"sharpness",
              &Planks::sharpness,
              "power of the rings' wave: larger is narrower late wood",
              "",
              {1, 64}},
        Field{"curl", &Planks::curl, "how far noise bends the rings", "rings", {0, 8}},
        Field{"grain", &Planks::grain, "strength of fibres and pores", "", {0, 1}},
        Field{"variation", &Planks::variation, "how much boards differ in tone", "", {0, 1}},
        Field{"relief", &Planks::relief, "height of the boards, for the light", "features", {0, 1}},
        Field{"colours",
              &Planks::colours,
              "colour ramp from early to late wood",
              "r, g, b, …",
              {0, 1}}};
  }
};
Texture paint(const Planks& params, const Canvas& canvas);

/// Ridges of bark along y, about a feature apart; mask: the fissures.
struct Bark {
  static constexpr std::string_view name = "bark";
  static constexpr std::string_view summary = "furrowed bark of an old tree";
  static constexpr bool solid = false;
  double stretch = 3;
  double fissure = 0.16;
  double relief = 0.34;
  std::vector<double> colours{0.25, 0.19, 0.14, 0.40, 0.32, 0.25,
                              0.52, 0.44, 0.36, 0.62, 0.56, 0.48};
  std::vector<double> fissure_colour{0.10, 0.07, 0.05};
  static constexpr auto fields() {
    return std::tuple{
        Field{"stretch", &Bark::stretch, "a ridge's length over its width", "", {1, 12}},
        Field{"fissure", &Bark::fissure, "width of the fissures", "features", {0, 0.6}},
        Field{"relief", &Bark::relief, "height of the ridges, for the light", "features", {0, 1}},
        Field{"colours", &Bark::colours, "colour ramp of the ridges", "r, g, b, …", {0, 1}},
        Field{"fissure_colour", &Bark::fissure_colour, "down in the fissures", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Bark& params, const Canvas& canvas);

}  // namespace gramloom
