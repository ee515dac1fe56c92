#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <utility>

#include "classic/patchmatch.h"
#include "classic/quilting.h"
#include "core/error.h"
#include "core/image.h"
#include "core/random.h"
#include "metrics/scores.h"
#include "procedural/texture.h"
#include "signal/grain.h"

namespace gramloom {

/// A procedural texture that tiles.
inline Image painted(ProceduralTexture texture, double scale, std::uint64_t seed = 1,
                     Size size = {128, 128}) {
  ProceduralParams params;
  params.texture = std::move(texture);
  params.scale = scale;
  params.samples = 2;
  return synthesise(params, {{}, Target{size, Tile::both}, Random(seed)}, {}).image;
}

inline Image brick(std::uint64_t seed = 1, int side = 128) {
  return painted(Brick{}, side / 43, seed, {side, side});
}
inline Image pebbles(std::uint64_t seed = 1, int side = 128) {
  return painted(Pebbles{}, side / 26, seed, {side, side});
}
inline Image stones(std::uint64_t seed = 1, int side = 128) {
  return painted(StoneWall{}, side / 26, seed, {side, side});
}

inline Image quilted(const Image& exemplar, Size size = {128, 128}) {
  return synthesise(QuiltingParams{}, {{{exemplar}}, Target{size, Tile::both}, Random(1)},
                    Control{})
      .image;
}

/// By the method that keeps structure best.
inline Image optimised(const Image& exemplar) {
  return synthesise(PatchmatchParams{},
                    {{{exemplar}}, Target{exemplar.size(), Tile::both}, Random(1)}, Control{})
      .image;
}

inline Image noisy(Image image, float deviation) {
  Random random(9);
  for (float& value : image.pixels) value += deviation * random.normal();
  return image;
}

inline Image blurred(const Image& image, double deviation) {
  Image result = image;
  cv::Mat pixels(image.height, image.width, CV_32FC(image.channels), result.pixels.data());
  cv::GaussianBlur(pixels.clone(), pixels, {}, deviation, deviation, cv::BORDER_REFLECT);
  return result;
}

inline double value(const Scores& scores, std::string_view name) {
  for (const auto& [of, score] : scores.values)
    if (of == name) return score;
  throw Error("there is no score {}", name);
}

}  // namespace gramloom
