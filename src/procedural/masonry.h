#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "core/request.h"
#include "procedural/canvas.h"

namespace gramloom {

/// Square tiles of one feature with grout between; mask: the grout.
struct Tiles {
  static constexpr std::string_view name = "tiles";
  static constexpr std::string_view summary = "glazed floor tiles with grout";
  static constexpr bool solid = false;
  double grout = 0.07;
  double bevel = 0.06;
  double marbling = 0.5;
  double variation = 0.35;
  double relief = 0.06;
  std::vector<double> colours{0.55, 0.30, 0.20, 0.72, 0.45, 0.31, 0.83, 0.60, 0.44};
  std::vector<double> grout_colour{0.66, 0.62, 0.56};
  static constexpr auto fields() {
    return std::tuple{
        Field{"grout", &Tiles::grout, "width of the grout", "features", {0, 0.9}},
        Field{"bevel", &Tiles::bevel, "width of the rounded rim", "features", {0.001, 0.5}},
        Field{"marbling", &Tiles::marbling, "clouds in the glaze", "", {0, 1}},
        Field{"variation",
              &Tiles::variation,
              "how much colours differ from tile to tile",
              "",
              {0, 1}},
        Field{"relief", &Tiles::relief, "height of the tiles, for the light", "features", {0, 1}},
        Field{"colours", &Tiles::colours, "colour ramp of the tiles", "r, g, b, …", {0, 1}},
        Field{"grout_colour", &Tiles::grout_colour, "of the grout", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Tiles& params, const Canvas& canvas);

/// Bricks in running bond, each a feature wide with its mortar; odd rows shifted by half a brick.
/// Mask: the mortar.
struct Brick {
  static constexpr std::string_view name = "brick";
  static constexpr std::string_view summary = "a brick wall in running bond";
  static constexpr bool solid = false;
  double aspect = 2.6;
  double mortar = 0.07;
  double shift = 0.5;
  double wear = 0.5;
  double variation = 0.8;
  double relief = 0.10;
  std::vector<double> colours{0.34, 0.13, 0.10, 0.55, 0.22, 0.15, 0.64, 0.29,
                              0.19, 0.70, 0.38, 0.26, 0.50, 0.27, 0.22};
  std::vector<double> mortar_colour{0.82, 0.79, 0.73};
  static constexpr auto fields() {
    return std::tuple{
        Field{"aspect",
              &Brick::aspect,
              "a brick's width over its height, with mortar",
              "",
              {0.2, 16}},
        Field{"mortar", &Brick::mortar, "width of the mortar", "features", {0, 0.5}},
        Field{"shift", &Brick::shift, "of odd rows", "bricks", {0, 1}},
        Field{"wear", &Brick::wear, "crooked edges, pits and stains", "", {0, 1}},
        Field{"variation",
              &Brick::variation,
              "how much colours differ from brick to brick",
              "",
              {0, 1}},
        Field{"relief", &Brick::relief, "height of the bricks, for the light", "features", {0, 1}},
        Field{"colours", &Brick::colours, "colour ramp of the bricks", "r, g, b, …", {0, 1}},
        Field{"mortar_colour", &Brick::mortar_colour, "of the mortar", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Brick& params, const Canvas& canvas);

/// Rough stones of about a feature, laid in mortar; mask: the mortar.
struct StoneWall {
  static constexpr std::string_view name = "stone_wall";
  static constexpr std::string_view summary = "a wall of rough stones in mortar";
  static constexpr bool solid = false;
  double flatness = 1.5;
  double mortar = 0.06;
  double roundness = 0.06;
  double relief = 0.16;
  std::vector<double> colours{0.30, 0.28, 0.26, 0.47, 0.43, 0.38, 0.58, 0.52,
                              0.43, 0.42, 0.42, 0.43, 0.63, 0.58, 0.51};
  std::vector<double> mortar_colour{0.55, 0.52, 0.47};
  static constexpr auto fields() {
    return std::tuple{
        Field{"flatness", &StoneWall::flatness, "a stone's width over its height", "", {0.2, 5}},
        Field{"mortar", &StoneWall::mortar, "width of the mortar", "features", {0, 0.4}},
        Field{
            "roundness", &StoneWall::roundness, "of the stones' corners", "features", {0.01, 0.3}},
        Field{"relief",
              &StoneWall::relief,
              "height of the stones, for the light",
              "features",
              {0, 1}},
        Field{"colours", &StoneWall::colours, "colour ramp of the stones", "r, g, b, …", {0, 1}},
        Field{"mortar_colour", &StoneWall::mortar_colour, "of the mortar", "r, g, b", {0, 1}}};
  }
};
Texture paint(const StoneWall& params, const Canvas& canvas);

}  // namespace gramloom
