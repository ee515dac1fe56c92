#pragma once

#include <vector>

#include "core/image.h"
#include "signal/patch_origin.h"
#include "signal/patch_sketch.h"

namespace gramloom {

/// What patches may be copied from.
struct PatchSource {
  Image features;
  std::vector<unsigned char> usable = {};  // origins, row by row; empty: all
  /// What is like this goes where the canvas's guide is alike: pictures of field_features channels,
  /// of the features' size; none: anywhere.
  std::vector<Image> guide = {};
  std::vector<int> parts = {};  // first columns of pictures side by side; none: it is one picture
  // Made once for many searches: see prepare().
  SketchScale scale = {};
  std::vector<PatchSketch> sketches = {};

  Size origins() const { return patch_origins(features.size()); }
  std::size_t index(PatchOrigin o) const {
    return static_cast<std::size_t>(o.y) * static_cast<std::size_t>(origins().width) +
           static_cast<std::size_t>(o.x);
  }
  bool is_usable(PatchOrigin o) const { return usable.empty() || usable[index(o)] != 0; }
};

/// Makes the sketches that improve() and search_all() need.
void prepare(PatchSource& source);

/// What patches of a canvas are asked to be like, besides the canvas.
struct PatchGuide {
  std::vector<Image> wanted = {};  // as many pictures as the source's, of the canvas's size
  /// Of each patch's squared differences in the guide, row by row.
  std::vector<float> weight = {};
};

/// A picture of any channels as pictures of field_features channels, of which those beyond its own
/// are 0.
std::vector<Image> guide_planes(const Image& guide);

}  // namespace gramloom
