#pragma once

#include <cmath>
#include <cstring>

#include "core/request.h"
#include "patch_exemplars.h"

namespace gramloom {

inline Image stripes(int width, int height, int period) {
  Image image(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) *image.at(x, y) = (x + y) % period < period / 2 ? 1.0f : 0.0f;
  return image;
}

/// Bricks of 12×6 pixels in a bond, joints one pixel wide.
inline Image bricks(int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int along = (x + y / 6 % 2 * 6) % 12;
      const bool joint = y % 6 == 0 || along == 0;
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = joint ? 0.9f : 0.2f + 0.1f * float(c);
    }
  return image;
}

inline Image rectangle(Size size, int left, int top, int width, int height, float inside) {
  Image image(size, 1, 1 - inside);
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x)
      if (x < size.width && y < size.height) *image.at(x, y) = inside;
  return image;
}

/// A picture from itself, with holes whose contents are lost. `hole`: 1 is made.
inline Request fill_request(const Image& picture, const Image& hole, std::uint64_t seed = 1) {
  Image known = picture, usable(picture.size(), 1);
  for (std::size_t i = 0; i < hole.pixels.size(); ++i) {
    usable.pixels[i] = 1 - hole.pixels[i];
    const auto channels = static_cast<std::size_t>(picture.channels);
    if (hole.pixels[i] > 0.5f)
      std::fill_n(known.pixels.begin() + static_cast<std::ptrdiff_t>(i * channels), channels, 0.5f);
  }
  return {{{known, {}, usable}}, {picture.size(), Tile::none, known, hole}, Random(seed)};
}

/// How many pixels differ where the hole is, or where it is not.
inline int different(const Image& a, const Image& b, const Image& hole, bool inside) {
  int count = 0;
  for (std::size_t i = 0; i < hole.pixels.size(); ++i) {
    if ((hole.pixels[i] > 0.5f) != inside) continue;
    const auto channels = static_cast<std::size_t>(a.channels);
    count += std::memcmp(&a.pixels[i * channels], &b.pixels[i * channels],
                         channels * sizeof(float)) != 0;
  }
  return count;
}

/// Two materials side by side, 0 and 1 of the guide's two channels, and a target of a disc of the
/// one in the other.
inline Request label_request(Size size, std::uint64_t seed = 1) {
  const Image left = blobs(48, 48, 3, 1), right = blobs(48, 48, 3, 2);
  Exemplar exemplar{Image(96, 48, 3), {}, {}, Image(96, 48, 2)};
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 96; ++x) {
      for (int c = 0; c < 3; ++c)
        exemplar.image.at(x, y)[c] = x < 48 ? left.at(x, y)[c] : 1 - right.at(x - 48, y)[c] / 4;
      exemplar.guide.at(x, y)[x < 48 ? 0 : 1] = 1;
    }
  Target target{.size = size, .guide = Image(size, 2), .guide_weight = Image(1, 1, 1, 10.0f)};
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const bool disc = std::hypot(x - size.width / 2, y - size.height / 2) < size.width / 4;
      target.guide.at(x, y)[disc ? 0 : 1] = 1;
    }
  return {{exemplar}, target, Random(seed)};
}

/// The share of pixels whose source has the guide that the target asks for.
inline double honoured(const Texture& texture, const Request& request) {
  int right = 0;
  for (int y = 0; y < texture.image.height; ++y)
    for (int x = 0; x < texture.image.width; ++x) {
      const Source from = *texture.source.at(x, y);
      const Image& guide = request.exemplars[from.exemplar].guide;
      right += pixel_at(guide, static_cast<int>(from.x), static_cast<int>(from.y)) ==
               pixel_at(request.target.guide, x, y);
    }
  return right / (1.0 * texture.image.width * texture.image.height);
}

/// How many pixels come from where the mask is 0.
inline int masked_sources(const Texture& texture, const Request& request) {
  int count = 0;
  for (std::size_t i = 0; i < texture.source.pixels.size(); ++i) {
    const Source from = texture.source.pixels[i];
    const Image& mask = request.exemplars[from.exemplar].mask;
    const bool made = request.target.mask.empty() || request.target.mask.pixels[i] > 0.5f;
    if (made && !mask.empty())
      count += *mask.at(static_cast<int>(from.x), static_cast<int>(from.y)) < 0.5f;
  }
  return count;
}

/// How much of a texture comes from each exemplar.
inline std::vector<double> shares(const Texture& texture, std::size_t exemplars) {
  std::vector<double> result(exemplars);
  for (const Source from : texture.source.pixels)
    result[from.exemplar] += 1.0 / static_cast<double>(texture.source.pixels.size());
  return result;
}

}  // namespace gramloom
