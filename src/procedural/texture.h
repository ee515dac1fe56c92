#pragma once

#include <string_view>
#include <tuple>
#include <variant>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"
#include "procedural/ground.h"
#include "procedural/masonry.h"
#include "procedural/minerals.h"
#include "procedural/noise_texture.h"
#include "procedural/patterns.h"
#include "procedural/textile.h"
#include "procedural/weather.h"
#include "procedural/wood.h"

namespace gramloom {

/// Every texture made from formulas: the one list of them. Each has a `name` that the config
/// writes, a `summary`, a field list, and a function `paint`.
using ProceduralTexture =
    std::variant<Noise, Cellular, Stripes, Checkerboard, Hexagons, Dots, Tiles, Brick, StoneWall,
                 Marble, Granite, Stucco, Pebbles, CrackedMud, Grass, Sand, Wood, Planks, Bark,
                 Weave, Cloth, Leather, Clouds, Fire, Rust>;

/// A texture from formulas: which one, and the settings that all of them share.
struct ProceduralParams {
  static constexpr std::string_view kind = "procedural";
  static constexpr std::string_view summary = "a texture from formulas, without an exemplar";
  static constexpr Abilities abilities{};
  /// The config's key that chooses the alternative of `texture` by its name.
  static constexpr std::string_view variant_key = "texture";
  ProceduralTexture texture = Noise{};

  double scale = 8;
  int samples = 3;
  double light = 135;
  double depth = 0;
  double tilt = 0;
  double turn = 0;
  int frames = 1;
  double travel = 1;
  bool loop = false;

  /// The shared settings; the texture's own are in its fields().
  static constexpr auto fields() {
    using P = ProceduralParams;
    return std::tuple{
        Field{"scale", &P::scale, "features along the shorter side", "", {0.25, 512}},
        Field{"samples", &P::samples, "samples a pixel, along x and along y", "", {1, 16}},
        Field{"light",
              &P::light,
              "where the light comes from: 0 is right, 90 above",
              "degrees",
              {-360, 360}},
        Field{
            "depth", &P::depth, "where the picture's plane cuts a solid", "features", {-1e4, 1e4}},
        Field{"tilt", &P::tilt, "of the plane around the picture's x axis", "degrees", {-360, 360}},
        Field{"turn", &P::turn, "of the plane around the picture's y axis", "degrees", {-360, 360}},
        Field{"frames", &P::frames, "pictures of a sequence", "", {1, 9999}},
        Field{"travel",
              &P::travel,
              "how far the sequence moves through the solid",
              "features",
              {0, 1e4}},
        Field{"loop", &P::loop, "whether the last frame leads back to the first"}};
  }
};

/// The texture of the target's size, seamless along its tiling axes, with the maps that it has:
/// "height" and "mask" with one channel in [0, 1], and "frame_0001", … of a sequence, of which
/// `image` is the first. A solid texture is cut by the plane that depth, tilt and turn describe,
/// and a sequence moves this plane along its normal (4-D noise: through the fourth dimension).
/// Throws ConfigError for parameters that are out of range or don't fit together (a flat texture
/// has no depth, a tilted plane does not tile), Error for a request that check_request() refuses,
/// as one with an exemplar, Interrupted when told to stop.
Texture synthesise(const ProceduralParams& params, const Request& request, const Control& control);

Cost estimate(const ProceduralParams& params, const RequestSize& request);

}  // namespace gramloom
