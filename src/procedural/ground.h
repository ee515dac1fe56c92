#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "core/request.h"
#include "procedural/canvas.h"

namespace gramloom {

/// Round stones of about a feature, smaller ones showing between them, on sand; mask: the stones.
struct Pebbles {
  static constexpr std::string_view name = "pebbles";
  static constexpr std::string_view summary = "round stones, smaller ones between, on sand";
  static constexpr bool solid = false;
  double gap = 0.05;
  double roundness = 0.10;
  double stripes = 0.5;
  double relief = 0.38;
  std::vector<double> colours{0.24, 0.25, 0.28, 0.44, 0.43, 0.43, 0.62, 0.58,
                              0.52, 0.52, 0.42, 0.34, 0.74, 0.70, 0.64, 0.40,
                              0.36, 0.33, 0.60, 0.60, 0.61, 0.84, 0.82, 0.78};
  std::vector<double> sand_colour{0.42, 0.36, 0.28};
  static constexpr auto fields() {
    return std::tuple{
        Field{"gap", &Pebbles::gap, "between stones", "features", {0, 0.3}},
        Field{"roundness", &Pebbles::roundness, "of the stones' outline", "features", {0.01, 0.3}},
        Field{"stripes", &Pebbles::stripes, "strength of layers in the stones", "", {0, 1}},
        Field{
            "relief", &Pebbles::relief, "height of the stones, for the light", "features", {0, 1}},
        Field{"colours", &Pebbles::colours, "colour ramp of the stones", "r, g, b, …", {0, 1}},
        Field{"sand_colour", &Pebbles::sand_colour, "of the sand between", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Pebbles& params, const Canvas& canvas);

/// Plates of dried mud of about a feature, with finer cracks in them; mask: the cracks.
struct CrackedMud {
  static constexpr std::string_view name = "cracked_mud";
  static constexpr std::string_view summary = "plates of dried mud between cracks";
  static constexpr bool solid = false;
  double crack = 0.07;
  double fine_cracks = 0.6;
  double curl = 0.5;
  double relief = 0.20;
  std::vector<double> colours{0.50, 0.40, 0.31, 0.63, 0.52, 0.41,
                              0.71, 0.61, 0.50, 0.78, 0.69, 0.58};
  std::vector<double> crack_colour{0.17, 0.12, 0.09};
  static constexpr auto fields() {
    return std::tuple{
        Field{"crack", &CrackedMud::crack, "width of the cracks", "features", {0, 0.5}},
        Field{
            "fine_cracks", &CrackedMud::fine_cracks, "strength of those in the plates", "", {0, 1}},
        Field{"curl", &CrackedMud::curl, "how far the plates' rims curl up", "", {0, 1}},
        Field{"relief",
              &CrackedMud::relief,
              "height of the plates, for the light",
              "features",
              {0, 1}},
        Field{"colours", &CrackedMud::colours, "colour ramp of the plates", "r, g, b, …", {0, 1}},
        Field{"crack_colour", &CrackedMud::crack_colour, "down in the cracks", "r, g, b", {0, 1}}};
  }
};
Texture paint(const CrackedMud& params, const Canvas& canvas);

/// Blades of about a feature's length, in layers from dark roots to light tips.
struct Grass {
  static constexpr std::string_view name = "grass";
  static constexpr std::string_view summary = "blades of grass seen from above";
  static constexpr bool solid = false;
  int layers = 8;
  double blade_width = 0.10;
  double combing = 0.45;
  double dry = 0.12;
  std::vector<double> colours{0.05, 0.13, 0.03, 0.14, 0.29, 0.07, 0.27, 0.45,
                              0.12, 0.42, 0.58, 0.20, 0.58, 0.70, 0.32};
  std::vector<double> dry_colour{0.66, 0.60, 0.34};
  static constexpr auto fields() {
    return std::tuple{
        Field{"layers", &Grass::layers, "of blades", "", {1, 24}},
        Field{"blade_width", &Grass::blade_width, "at the root", "features", {0.005, 0.3}},
        Field{"combing", &Grass::combing, "0: blades point anywhere; 1: all one way", "", {0, 1}},
        Field{"dry", &Grass::dry, "part of the blades that are dry", "", {0, 1}},
        Field{"colours",
              &Grass::colours,
              "colour ramp from the lowest to the highest",
              "r, g, b, …",
              {0, 1}},
        Field{"dry_colour", &Grass::dry_colour, "of dry blades", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Grass& params, const Canvas& canvas);

/// Sand that wind has blown into ripples of a feature's length.
struct Sand {
  static constexpr std::string_view name = "sand";
  static constexpr std::string_view summary = "wind ripples in sand";
  static constexpr bool solid = false;
  double waviness = 0.5;
  double grain = 0.5;
  double relief = 0.16;
  std::vector<double> colours{0.62, 0.47, 0.31, 0.78, 0.63, 0.44, 0.88, 0.76, 0.57};
  static constexpr auto fields() {
    return std::tuple{
        Field{"waviness", &Sand::waviness, "how far the ripples stray", "features", {0, 4}},
        Field{"grain", &Sand::grain, "how much grains differ", "", {0, 1}},
        Field{"relief", &Sand::relief, "height of the ripples, for the light", "features", {0, 1}},
        Field{
            "colours", &Sand::colours, "colour ramp from troughs to crests", "r, g, b, …", {0, 1}}};
  }
};
Texture paint(const Sand& params, const Canvas& canvas);

}  // namespace gramloom
