#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/image.h"
#include "surface/coordinates.h"
#include "surface/environment.h"
#include "surface/normal_map.h"
#include "surface/shading.h"
#include "surface/shapes.h"
#include "surface/texture_lookup.h"

namespace gramloom {

/// Where the normals of a shape's vertices come from: the shape itself (a file's own, or smooth
/// ones), means of the faces' by area or by angle, or none: each face flat.
enum class Normals { own, area, angle, flat };
template <>
inline constexpr auto enum_names<Normals> = std::to_array<std::string_view>({"own", "area", "angle",
                                                                             "flat"});

/// What is behind the shape: an even studio, the surroundings, or nothing (an alpha channel).
enum class Background { studio, environment, transparent };
template <>
inline constexpr auto enum_names<Background> =
    std::to_array<std::string_view>({"studio", "environment", "transparent"});

/// How two materials share a shape.
enum class Pattern { checkerboard, stripes };
template <>
inline constexpr auto enum_names<Pattern> = std::to_array<std::string_view>({"checkerboard",
                                                                             "stripes"});

/// A texture on a shape under a lamp: the [preview] of a config, and the options of `gramloom
/// preview`. Lengths are in radii of the shape, which fits a ball of radius 1.
struct PreviewParams {
  static constexpr std::string_view name = "preview";
  static constexpr std::string_view summary = "a picture of the texture on a shape under a lamp";

  FileOrName shape = "sphere";
  double bend = 0;
  Size size{512, 512};
  int samples = 4;
  std::vector<double> repeat;
  bool stochastic = false;
  double stochastic_rotation = 0;

  Mapping mapping = Mapping::own;
  std::vector<double> mapping_origin{0, 0, 0};
  std::vector<double> pole{0, 1, 0};
  std::vector<double> seam{0, 0, -1};
  double mapping_size = 2;
  std::vector<double> u_axis{2, 0, 0};
  std::vector<double> v_axis{0, 2, 0};
  double cone_angle = 26.565;

  Lookup lookup = Lookup::filtered;
  Outside outside = Outside::tile;
  std::vector<double> outside_colour{0.5, 0.5, 0.5};

  Shading shading = Shading::metal;
  std::vector<double> colour{1, 1, 1};
  double roughness = 0.6;
  double metalness = 0;
  double specular = 0.3;
  double shininess = 32;

  double bump = 0.04;
  double displacement = 0;
  double detail = 3;
  std::optional<GreenAxis> green;
  Normals normals = Normals::own;
  Pattern pattern = Pattern::checkerboard;
  double pattern_repeat = 4;

  std::vector<double> light{-40, 42};
  double light_strength = 1;
  std::vector<double> light_colour{1, 0.96, 0.91};
  double light_size = 8;

  std::vector<std::filesystem::path> environment;
  EnvironmentKind environment_kind = EnvironmentKind::automatic;
  double environment_strength = 0.55;
  double environment_turn = 0;

  std::vector<double> view;
  double zoom = 1;
  bool ground = true;
  Background background = Background::studio;
  std::vector<double> background_colour{0.88, 0.88, 0.89};

  friend bool operator==(const PreviewParams&, const PreviewParams&) = default;

  static constexpr auto fields() {
    using P = PreviewParams;
    return std::tuple{
        Field{"shape", &P::shape, "sphere, plane, cube, cylinder, teapot, tube, or an OBJ file"},
        Field{"bend", &P::bend, "of the tube at its middle, as an elbow", "degrees", {0, 120}},
        Field{"size", &P::size, "width and height of the picture", "pixels", {1, 8192}},
        Field{"samples", &P::samples, "samples a pixel, along x and along y", "", {1, 16}},
        Field{"repeat",
              &P::repeat,
              "how often the texture goes over the shape: up it, with as many around as keep it "
              "square; or along u and along v",
              "",
              {1e-3, 1e4}},
        Field{"stochastic", &P::stochastic,
              "repeat without repetition: pieces from random places of the texture, blended"},
        Field{"stochastic_rotation",
              &P::stochastic_rotation,
              "of those pieces, by up to this either way",
              "degrees",
              {0, 180}},
        Field{"mapping", &P::mapping,
              "where texture coordinates come from: the shape, a formula, "
              "or, solid, the point itself"},
        Field{"mapping_origin",
              &P::mapping_origin,
              "where the mapping's middle is",
              "x, y, z",
              {-1e3, 1e3}},
        Field{"pole", &P::pole, "the mapping's axis", "x, y, z", {-1e3, 1e3}},
        Field{"seam", &P::seam, "where u is 0, seen from the axis", "x, y, z", {-1e3, 1e3}},
        Field{"mapping_size",
              &P::mapping_size,
              "the length that a picture covers",
              "radii",
              {1e-3, 1e3}},
        Field{"u_axis", &P::u_axis, "linear: along which u grows by 1", "x, y, z", {-1e3, 1e3}},
        Field{"v_axis", &P::v_axis, "linear: along which v grows by 1", "x, y, z", {-1e3, 1e3}},
        Field{"cone_angle", &P::cone_angle, "conical: between axis and side", "degrees", {1, 89}},
        Field{"lookup", &P::lookup, "between a picture's pixels"},
        Field{"outside", &P::outside, "what is beyond a picture's edges"},
        Field{"outside_colour", &P::outside_colour, "if that is a colour", "r, g, b", {0, 1}},
        Field{"shading", &P::shading, "how the surface answers light"},
        Field{"colour", &P::colour, "by which the texture's is multiplied", "r, g, b", {0, 1}},
        Field{
            "roughness", &P::roughness, "metal: of the surface, where no map says it", "", {0, 1}},
        Field{"metalness", &P::metalness, "metal: likewise", "", {0, 1}},
        Field{"specular", &P::specular, "phong: strength of highlights", "", {0, 1}},
        Field{"shininess", &P::shininess, "phong: exponent of highlights", "", {1, 1e4}},
        Field{"bump",
              &P::bump,
              "how high a height of 1 seems to stand, where nothing is displaced",
              "radii",
              {-2, 2}},
        Field{"displacement", &P::displacement, "how high a height of 1 stands", "radii", {-2, 2}},
        Field{"detail",
              &P::detail,
              "length of a displaced mesh's edges, in the picture",
              "pixels",
              {0.25, 64}},
        Field{"green", &P::green,
              "where a normal map's green points: up the picture (OpenGL), down (DirectX); as the "
              "map itself or its name says if not set"},
        Field{"normals", &P::normals, "of the shape: its own, means of the faces', or flat faces"},
        Field{"pattern", &P::pattern, "by which two materials share the shape"},
        Field{"pattern_repeat",
              &P::pattern_repeat,
              "its squares or stripes along a radius",
              "",
              {0.1, 1e3}},
        Field{"light",
              &P::light,
              "where the lamp is: 0 ahead, 90 right; and above the horizon",
              "degrees",
              {-360, 360}},
        Field{"light_strength",
              &P::light_strength,
              "1 makes a white Lambert surface white",
              "",
              {0, 1e4}},
        Field{"light_colour", &P::light_colour, "of the lamp", "r, g, b", {0, 1}},
        Field{"light_size",
              &P::light_size,
              "its diameter as seen from the shape: soft shadows",
              "degrees",
              {0, 90}},
        Field{"environment", &P::environment,
              "a picture of the surroundings, or the six faces of a sky box (+x, -x, +y, -y, +z, "
              "-z); a studio if not set"},
        Field{"environment_kind", &P::environment_kind, "what that picture shows"},
        Field{"environment_strength", &P::environment_strength, "of its light", "", {0, 1e4}},
        Field{
            "environment_turn", &P::environment_turn, "around the upright", "degrees", {-360, 360}},
        Field{"view",
              &P::view,
              "where the camera is: 0 ahead, 90 right; and above the horizon; by the shape if not "
              "set",
              "degrees",
              {-360, 360}},
        Field{"zoom", &P::zoom, "2: twice as large", "", {0.01, 1e3}},
        Field{"ground", &P::ground, "whether the shape stands on a ground that takes its shadow"},
        Field{"background", &P::background, "what is behind the shape"},
        Field{"background_colour", &P::background_colour, "of the studio", "r, g, b", {0, 1}},
    };
  }
};

}  // namespace gramloom
