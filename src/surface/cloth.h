#pragma once

#include "core/fields.h"
#include "core/image.h"
#include "surface/cloth_sheet.h"

namespace gramloom {

/// Degrees.
inline constexpr Range bend_range{0, 120};
inline constexpr Range turn_range{-120, 120};

/// How an arm is held, in degrees. Arm and sleeve start straight.
struct Pose {
  double bend = 0;   // of the elbow
  double twist = 0;  // of the forearm about its axis: the cuff turns with it
  double swing = 0;  // of the upper arm about its own: the sleeve's upper end stays behind as much

  friend bool operator==(const Pose&, const Pose&) = default;

  static constexpr auto fields() {
    using P = Pose;
    return std::tuple{
        Field{"bend", &P::bend, "of the elbow", "degrees", bend_range},
        Field{"twist", &P::twist, "of the forearm about its axis", "degrees", turn_range},
        Field{"swing", &P::swing, "of the upper arm about its axis", "degrees", turn_range},
    };
  }
};

/// A sleeve of cloth around an arm: a tube whose points are kept apart as they were at rest.
struct ClothParams {
  static constexpr std::string_view name = "sleeve";
  static constexpr std::string_view summary = "cloth around an elbow that bends";

  Size size{64, 64};
  double slack = 0.3;
  double stretch = 1;
  double shear = 0.4;
  double bending = 0.5;
  double fold = 0.5;
  int steps = 40;
  int iterations = 12;

  friend bool operator==(const ClothParams&, const ClothParams&) = default;

  static constexpr auto fields() {
    using C = ClothParams;
    return std::tuple{
        Field{"size", &C::size, "points of the cloth around and along the arm", "", {8, 512}},
        Field{"slack", &C::slack, "between sleeve and arm", "radii", {0, 0.6}},
        Field{"stretch", &C::stretch, "share of a change of length undone at a time", "", {0.1, 1}},
        Field{"shear", &C::shear, "likewise, of diagonals", "", {0, 1}},
        Field{"bending", &C::bending, "likewise, of lengths over two edges", "", {0, 1}},
        Field{"fold",
              &C::fold,
              "length over which cloth bends as little as over two edges",
              "radii",
              {0, 2}},
        Field{"steps", &C::steps, "in which the arm bends", "", {1, 1000}},
        Field{"iterations", &C::iterations, "in each step, over all lengths", "", {1, 1000}},
    };
  }
};

/// The sleeve in its pose: bent from rest in steps, so that it depends on pose and params alone.
/// The same bytes on every machine. Throws ConfigError for params out of range.
ClothSheet bent_sleeve(const ClothParams& params, const Pose& pose);

/// How far that lies outside the arm's tube, in radii of the sleeve: see displacement_picture().
Image sleeve_displacement(const ClothParams& params, const Pose& pose);

}  // namespace gramloom
