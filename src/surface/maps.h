#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/cost.h"
#include "core/fields.h"
#include "core/image.h"
#include "core/progress.h"
#include "surface/normal_map.h"

namespace gramloom {

/// Which maps are made of a height map, and how: the [surface] of a config, and the options of
/// `gramloom maps`.
struct MapParams {
  static constexpr std::string_view name = "surface";
  static constexpr std::string_view summary = "maps made of a height map";

  bool normal = false;
  bool occlusion = false;
  bool curvature = false;
  double strength = 8;
  GreenAxis green = GreenAxis::up;
  int occlusion_radius = 32;
  int occlusion_lines = 8;
  double curvature_radius = 4;
  double curvature_scale = 2;

  friend bool operator==(const MapParams&, const MapParams&) = default;

  static constexpr auto fields() {
    using M = MapParams;
    return std::tuple{
        Field{"normal", &M::normal, "a normal map, in tangent space"},
        Field{"occlusion", &M::occlusion,
              "an ambient occlusion map: white where all the sky is seen"},
        Field{"curvature", &M::curvature,
              "a curvature map: grey is flat, white a ridge, black a groove"},
        Field{"strength", &M::strength, "how high a height of 1 stands", "pixels", {1e-3, 1e5}},
        Field{"green", &M::green,
              "where a normal map's green points: up the picture (OpenGL), down (DirectX)"},
        Field{"occlusion_radius",
              &M::occlusion_radius,
              "how far the horizon is looked for",
              "pixels",
              {1, 1024}},
        Field{"occlusion_lines",
              &M::occlusion_lines,
              "through each point, along which the horizon is looked for",
              "",
              {1, 64}},
        Field{"curvature_radius",
              &M::curvature_radius,
              "of the ball whose top is white",
              "pixels",
              {1e-3, 1e5}},
        Field{"curvature_scale",
              &M::curvature_scale,
              "of the details that the curvature map leaves out: the deviation of a Gaussian that "
              "the height is weighted by first",
              "pixels",
              {0, 100}},
    };
  }
};

/// The [surface] of a config: these maps of every result that has a height.
struct SurfaceParams : MapParams {
  std::string height = "height";
  bool guess = false;

  friend bool operator==(const SurfaceParams&, const SurfaceParams&) = default;

  static constexpr auto fields() {
    return std::tuple_cat(
        MapParams::fields(),
        std::tuple{Field{"height", &SurfaceParams::height,
                         "the exemplar's map that is the height, of one channel; 'height' where a "
                         "texture has none of this name"},
                   Field{"guess", &SurfaceParams::guess,
                         "guess height and roughness from the colours of a texture whose "
                         "exemplar has no height, as 'gramloom maps --from-photo' does"}});
  }
};

/// The map of these that is the height; "" where there is none.
template <class Maps>
std::string height_among(const Maps& maps, const SurfaceParams& params) {
  if (maps.contains(params.height)) return params.height;
  return maps.contains("height") ? "height" : "";
}

/// What making them takes for a height of this size, and for that, if it is guessed.
Cost estimate_maps(const MapParams& params, Size size);
Cost estimate_maps(const SurfaceParams& params, Size size, Tile wraps);

/// The names of the maps that are asked for: "normal", "occlusion", "curvature".
std::vector<std::string> maps_asked(const MapParams& params);
/// Whether any map is made.
bool makes_any(const SurfaceParams& params);

/// These maps of a height map, by name, as they stand in files: normals as colours. `wraps`: the
/// axes on which the map tiles. Throws Error for a height map of more than one channel.
std::map<std::string, Image> maps_of_height(const Image& height, const MapParams& params,
                                            Tile wraps);

/// A height map as one channel. Grey that a file stores as colours counts as one: channels that
/// differ nowhere by more than three steps of 8 bits, which JPEG may make of it. Throws Error for
/// others, which calls it as here.
Image one_channel(const Image& map, std::string_view called = "height");

}  // namespace gramloom
