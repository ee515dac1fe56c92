#pragma once

#include <vector>

#include "core/request.h"
#include "signal/patch_tree.h"

namespace gramloom {

/// Side of the blocks that count as copied, in pixels.
inline constexpr int copy_block = 16;
/// A block is copied when, at the shift of one of five of its nearest patches, it differs from the
/// exemplar by at most this part of its own variance: -10 dB lets JPEG at quality 50 and noise of
/// up to 0.3 of its deviation pass, while pieces of another picture of the same texture do not.
inline constexpr double copy_tolerance = 0.1;
/// Where the five agree on the shift, which without copying is rare, this part may differ.
inline constexpr double copy_tolerance_agreed = 0.5;
/// Blocks with less than this part of the exemplar's variance say nothing and are not counted.
inline constexpr double copy_flat = 0.01;

struct Copying {
  /// Of the area of blocks that are not flat, in copied ones; 0 if all are flat.
  double share = 0;
  /// Of pairs of neighbouring patches, with nearest patches that are neighbours likewise.
  double coherence = 0;
  Image map;  // see Scores::copy_map
};

/// Of pictures of components, and the exemplar's tree; the map has their size, and the colours of
/// `source` where that is not empty. Nearest patches as in nearest_patches.h; blocks lie 4 pixels
/// apart.
Copying copying(const Image& exemplar, const PatchTree& tree, const Image& image,
                const SourceMap& source = {});

/// Where each pixel came from of exemplars of these sizes: as in Scores::copy_map at full
/// brightness, the colours' channels exchanged from exemplar to exemplar.
Image source_colours(const SourceMap& source, const std::vector<Size>& exemplars);

}  // namespace gramloom
