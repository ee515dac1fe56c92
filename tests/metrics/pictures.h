#pragma once

#include "classic/quilting.h"
#include "core/image.h"
#include "metrics/scores.h"
#include "procedural/texture.h"

namespace gramloom {

/// A tileable procedural texture.
inline Image painted(ProceduralTexture texture, Size size, std::uint64_t seed, double scale) {
  ProceduralParams params;
  params.texture = std::move(texture);
  params.scale = scale;
  params.samples = 2;
  return synthesise(params, Target{size, Tile::both}, Random(seed)).image;
}

inline Image cropped(const Image& image, int left, int top, Size size) {
  Image result(size, image.channels);
  for (int y = 0; y < size.height; ++y)
    std::copy_n(image.at(left, top + y), size.width * image.channels, result.at(0, y));
  return result;
}

inline double value(const Scores& scores, std::string_view name) {
  for (const auto& [of, score] : scores.values)
    if (of == name) return score;
  throw Error("no score {}", name);
}

}  // namespace gramloom
