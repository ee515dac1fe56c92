#pragma once

#include <string_view>
#include <tuple>
#include <variant>

#include "core/fields.h"
#include "core/image.h"
#include "core/progress.h"
#include "core/random.h"
#include "procedural/noise_texture.h"
#include "procedural/patterns.h"

namespace gramloom {

/// Every texture made from formulas: the one list of them. Each has a `name` that the config
/// writes, a `summary` and a field list.
using ProceduralTexture = std::variant<Noise, Checkerboard>;

/// A texture from formulas: which one, and the settings that all of them share.
struct ProceduralParams {
  static constexpr std::string_view kind = "procedural";
  static constexpr std::string_view summary = "a texture from formulas, without an exemplar";
  /// The config's key that chooses the alternative of `texture` by its name.
  static constexpr std::string_view variant_key = "texture";
  ProceduralTexture texture = Noise{};

  double scale = 8;
  int samples = 3;
  int frames = 1;

  /// The shared settings; the texture's own are in its fields().
  static constexpr auto fields() {
    return std::tuple{
        Field{
            "scale", &ProceduralParams::scale, "features along the shorter side", "", {0.25, 512}},
        Field{"samples",
              &ProceduralParams::samples,
              "samples a pixel, along x and along y",
              "",
              {1, 16}},
        Field{"frames", &ProceduralParams::frames, "pictures of a sequence", "", {1, 9999}}};
  }
};

/// The texture of `target`'s size, seamless along its tiling axes; maps "height" and "mask" where
/// the texture has them, and "frame_0001", … of a sequence.
/// Throws ConfigError for parameters out of range, Interrupted when told to stop.
Texture synthesise(const ProceduralParams& params, const Target& target, Random random,
                   const Control& control = {});

Cost estimate(const ProceduralParams& params, const Target& target);

}  // namespace gramloom
