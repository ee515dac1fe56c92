#pragma once

#include "core/image.h"

namespace gramloom {

/// Side of the blocks that count as copied, in pixels.
inline constexpr int copy_block = 16;
/// A block is copied when, at the shift of one of five of its nearest patches, it differs from the
/// exemplar by at most this part of its own variance: -13 dB lets JPEG at quality 75 and
/// noise of a fifth of its deviation pass.
inline constexpr double copy_tolerance = 0.05;
/// Blocks with less than this part of the exemplar's variance say nothing and are not counted.
inline constexpr double copy_flat = 0.01;

struct Copying {
  double share = 0;  // of the area of blocks that are not flat, in copied ones; 0 if all are
  double coherence =
      0;      // of pairs of neighbouring patches whose nearest patches are neighbours too
  Image map;  // see Scores::copy_map
};

/// Of pictures of components; the map has their size. Nearest patches as in nearest_patches.h;
/// blocks lie 4 pixels apart.
Copying copying(const Image& exemplar, const Image& image);

}  // namespace gramloom
