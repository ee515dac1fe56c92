#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "core/request.h"
#include "procedural/canvas.h"

namespace gramloom {

/// Two colours by the sign of sin(πx/w), as wide as half a feature each; turbulence bends them.
struct Stripes {
  static constexpr std::string_view name = "stripes";
  static constexpr std::string_view summary = "stripes of two colours, straight or turbulent";
  static constexpr bool solid = true;
  double slant = 0;
  double turbulence = 0;
  int octaves = 4;
  double softness = 0;
  std::vector<double> first{0.90, 0.87, 0.78};
  std::vector<double> second{0.16, 0.27, 0.42};
  static constexpr auto fields() {
    return std::tuple{
        Field{"slant", &Stripes::slant, "stripes more along y for each one along x", "", {-16, 16}},
        Field{"turbulence",
              &Stripes::turbulence,
              "how far turbulence moves them",
              "features",
              {0, 8}},
        Field{"octaves", &Stripes::octaves, "of the turbulence", "", {1, max_octaves}},
        Field{"softness", &Stripes::softness, "0: sharp edges; 1: a sine wave", "", {0, 1}},
        Field{"first", &Stripes::first, "one colour", "r, g, b", {0, 1}},
        Field{"second", &Stripes::second, "the other colour", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Stripes& params, const Canvas& canvas);

/// Cubes of one feature, of two colours in turn.
struct Checkerboard {
  static constexpr std::string_view name = "checkerboard";
  static constexpr std::string_view summary = "two colours in turn: squares, or cubes of a solid";
  static constexpr bool solid = true;
  std::vector<double> first{0.93, 0.91, 0.86};
  std::vector<double> second{0.13, 0.12, 0.12};
  static constexpr auto fields() {
    return std::tuple{
        Field{"first", &Checkerboard::first, "one colour", "r, g, b", {0, 1}},
        Field{"second", &Checkerboard::second, "the other colour", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Checkerboard& params, const Canvas& canvas);

/// Regular hexagons (slightly stretched where the picture tiles) with joints, mask: the joints.
struct Hexagons {
  static constexpr std::string_view name = "hexagons";
  static constexpr std::string_view summary = "hexagonal tiles with joints";
  static constexpr bool solid = false;
  double joint = 0.08;
  double variation = 0.6;
  double relief = 0.05;
  std::vector<double> colours{0.22, 0.36, 0.42, 0.62, 0.74, 0.72, 0.88, 0.84, 0.70};
  std::vector<double> joint_colour{0.80, 0.79, 0.76};
  static constexpr auto fields() {
    return std::tuple{
        Field{"joint", &Hexagons::joint, "width of the joints", "features", {0, 0.9}},
        Field{"variation",
              &Hexagons::variation,
              "how much colours differ from tile to tile",
              "",
              {0, 1}},
        Field{
            "relief", &Hexagons::relief, "height of the tiles, for the light", "features", {0, 1}},
        Field{"colours", &Hexagons::colours, "colour ramp of the tiles", "r, g, b, …", {0, 1}},
        Field{"joint_colour", &Hexagons::joint_colour, "of the joints", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Hexagons& params, const Canvas& canvas);

/// Discs on a square or staggered grid, at random sizes and places if asked; mask: the discs.
struct Dots {
  static constexpr std::string_view name = "dots";
  static constexpr std::string_view summary = "discs on a grid, regular or scattered";
  static constexpr bool solid = false;
  double radius = 0.3;
  double stagger = 0.5;
  double jitter = 0;
  double variation = 0;
  std::vector<double> colours{0.86, 0.22, 0.20};
  std::vector<double> ground{0.96, 0.93, 0.86};
  static constexpr auto fields() {
    return std::tuple{
        Field{"radius", &Dots::radius, "of a disc", "features", {0, 0.5}},
        Field{"stagger", &Dots::stagger, "shift of every other row", "features", {0, 1}},
        Field{"jitter",
              &Dots::jitter,
              "how far discs stray, as a part of the room they have",
              "",
              {0, 1}},
        Field{"variation", &Dots::variation, "how much smaller discs may be", "", {0, 1}},
        Field{"colours", &Dots::colours, "colour ramp of the discs", "r, g, b, …", {0, 1}},
        Field{"ground", &Dots::ground, "colour of the ground", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Dots& params, const Canvas& canvas);

}  // namespace gramloom
