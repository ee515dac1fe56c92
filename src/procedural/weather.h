#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"
#include "core/request.h"
#include "procedural/canvas.h"

namespace gramloom {

/// Clouds of about a feature's size in a blue sky; a sequence of frames drifts and changes.
struct Clouds {
  static constexpr std::string_view name = "clouds";
  static constexpr std::string_view summary = "white clouds in a blue sky";
  static constexpr bool solid = true;
  double cover = 0.5;
  double softness = 0.5;
  std::vector<double> sky{0.20, 0.42, 0.76, 0.42, 0.62, 0.88};
  std::vector<double> colours{0.56, 0.62, 0.70, 0.80, 0.84, 0.88, 0.98, 0.98, 0.98};
  static constexpr auto fields() {
    return std::tuple{
        Field{"cover", &Clouds::cover, "part of the sky that clouds hide, about", "", {0, 1}},
        Field{"softness", &Clouds::softness, "of their edges", "", {0.05, 1}},
        Field{"sky", &Clouds::sky, "colour ramp of the sky", "r, g, b, …", {0, 1}},
        Field{"colours",
              &Clouds::colours,
              "colour ramp of clouds from shadow to light",
              "r, g, b, …",
              {0, 1}}};
  }
};
Texture paint(const Clouds& params, const Canvas& canvas);

/// Flames licking upwards; they fade towards the top unless the picture tiles along y. A sequence
/// of frames flickers.
struct Fire {
  static constexpr std::string_view name = "fire";
  static constexpr std::string_view summary = "flames";
  static constexpr bool solid = true;
  double stretch = 2.2;
  double heat = 0.5;
  std::vector<double> colours{0.02, 0.01, 0.01, 0.22, 0.02, 0.01, 0.62, 0.08, 0.01, 0.93, 0.33,
                              0.03, 1.00, 0.66, 0.12, 1.00, 0.90, 0.45, 1.00, 0.99, 0.86};
  static constexpr auto fields() {
    return std::tuple{
        Field{"stretch", &Fire::stretch, "a flame's height over its width", "", {0.5, 8}},
        Field{"heat", &Fire::heat, "0: hardly any; 1: all white", "", {0, 1}},
        Field{"colours", &Fire::colours, "colour ramp from cold to hot", "r, g, b, …", {0, 1}}};
  }
};
Texture paint(const Fire& params, const Canvas& canvas);

/// Painted iron from which rust has broken out in patches of about a feature; mask: the rust.
struct Rust {
  static constexpr std::string_view name = "rust";
  static constexpr std::string_view summary = "rust breaking out of painted iron";
  static constexpr bool solid = false;
  double cover = 0.55;
  double streaks = 0.5;
  double relief = 0.10;
  std::vector<double> paint{0.36, 0.48, 0.47};
  std::vector<double> colours{0.17, 0.08, 0.05, 0.31, 0.14, 0.07, 0.46, 0.21,
                              0.09, 0.60, 0.31, 0.12, 0.70, 0.42, 0.20};
  static constexpr auto fields() {
    return std::tuple{
        Field{"cover", &Rust::cover, "part of the iron that is rusty, about", "", {0, 1}},
        Field{"streaks", &Rust::streaks, "strength of what rain has washed down", "", {0, 1}},
        Field{"relief", &Rust::relief, "thickness of the paint, for the light", "features", {0, 1}},
        Field{"paint", &Rust::paint, "colour of the paint", "r, g, b", {0, 1}},
        Field{"colours", &Rust::colours, "colour ramp of the rust", "r, g, b, …", {0, 1}}};
  }
};
Texture paint(const Rust& params, const Canvas& canvas);

}  // namespace gramloom
