#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/image.h"

namespace gramloom {

/// The roughness of a material that has no map of it.
inline constexpr double usual_roughness = 0.8;

/// A material as pictures of one size, in values that do not depend on files.
struct MaterialSet {
  std::string name;             // "pebbles/quilting/seed1"
  Image colour;                 // sRGB, 0 to 1; three channels, or four with alpha
  std::optional<Image> normal;  // unit vectors, y up the picture (surface/normal_map.h)
  std::optional<Image> height, roughness, metalness, occlusion;  // one channel, 0 to 1
  double strength = 8;                                           // pixels that a height of 1 stands
  Tile tile = Tile::none;  // the axes on which the pictures tile
};

}  // namespace gramloom
