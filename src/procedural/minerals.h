#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "core/request.h"
#include "procedural/noise_texture.h"

namespace gramloom {

/// Layers of colour bent by turbulence (Perlin 1985), carved from a solid: the ramp at
/// t = ½ + ½ sin(2π k·p + amplitude · turbulence(p)), or 1 − tᵖᵒʷᵉʳ; with fine veins of another
/// layer across it.
struct Marble {
  static constexpr std::string_view name = "marble";
  static constexpr std::string_view summary = "veined stone: layers bent by turbulence";
  static constexpr bool solid = true;
  std::vector<double> layers{0.22, 0.35, 0.3};
  double amplitude = 9;
  int octaves = 6;
  double lacunarity = 2;
  double gain = 0.5;
  int power = 6;
  double veins = 0.7;
  std::vector<double> colours{0.30, 0.31, 0.34, 0.56, 0.57, 0.60, 0.80, 0.80,
                              0.81, 0.91, 0.90, 0.89, 0.95, 0.94, 0.92};
  std::vector<double> positions;
  Curve curve = Curve::spline;
  std::vector<double> vein_colour{0.38, 0.36, 0.36};
  static constexpr auto fields() {
    return std::tuple{
        Field{"layers", &Marble::layers, "layers along x, y and depth", "per feature", {-64, 64}},
        Field{
            "amplitude", &Marble::amplitude, "how far turbulence bends them", "radians", {0, 200}},
        Field{"octaves", &Marble::octaves, "of the turbulence", "", {1, max_octaves}},
        Field{"lacunarity",
              &Marble::lacunarity,
              "frequency of an octave over the last one's",
              "",
              {1, 8}},
        Field{"gain", &Marble::gain, "amplitude of an octave over the last one's", "", {0, 1}},
        Field{"power",
              &Marble::power,
              "0: the sine itself; else 1 less its so manieth power: narrow veins",
              "",
              {0, 64}},
        Field{"veins", &Marble::veins, "strength of the fine veins", "", {0, 1}},
        Field{"colours", &Marble::colours, "colour ramp of the layers", "r, g, b, …", {0, 1}},
        Field{"positions",
              &Marble::positions,
              "where the ramp's colours are, rising; none: evenly",
              "",
              {0, 1}},
        Field{"curve", &Marble::curve, "between the ramp's colours"},
        Field{"vein_colour", &Marble::vein_colour, "of the fine veins", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Marble& params, const Canvas& canvas);

/// Grains of feldspar and quartz with flakes of dark mica.
struct Granite {
  static constexpr std::string_view name = "granite";
  static constexpr std::string_view summary = "grains of feldspar, quartz and mica";
  static constexpr bool solid = false;
  double mica = 0.3;
  double contrast = 0.8;
  std::vector<double> colours{0.86, 0.83, 0.80, 0.80, 0.66, 0.58, 0.74, 0.56,
                              0.48, 0.62, 0.60, 0.60, 0.50, 0.49, 0.50};
  std::vector<double> mica_colour{0.10, 0.10, 0.11};
  static constexpr auto fields() {
    return std::tuple{
        Field{"mica", &Granite::mica, "part of the flakes that are dark", "", {0, 1}},
        Field{"contrast", &Granite::contrast, "of the pale grains", "", {0, 2}},
        Field{"colours",
              &Granite::colours,
              "colours of the pale grains, one of them each",
              "r, g, b, …",
              {0, 1}},
        Field{"mica_colour", &Granite::mica_colour, "of the dark flakes", "r, g, b", {0, 1}}};
  }
};
Texture paint(const Granite& params, const Canvas& canvas);

/// Plaster thrown at a wall in drops of about a feature, and levelled.
struct Stucco {
  static constexpr std::string_view name = "stucco";
  static constexpr std::string_view summary = "rough plaster";
  static constexpr bool solid = false;
  double flattened = 0.7;
  double relief = 0.20;
  std::vector<double> colours{0.74, 0.70, 0.63, 0.86, 0.83, 0.77, 0.93, 0.91, 0.86};
  static constexpr auto fields() {
    return std::tuple{
        Field{"flattened", &Stucco::flattened, "how flat the drops are pressed", "", {0, 1}},
        Field{"relief", &Stucco::relief, "height of the drops, for the light", "features", {0, 1}},
        Field{"colours",
              &Stucco::colours,
              "colour ramp from hollows to drops",
              "r, g, b, …",
              {0, 1}}};
  }
};
Texture paint(const Stucco& params, const Canvas& canvas);

}  // namespace gramloom
