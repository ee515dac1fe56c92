#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "signal/patch_origin.h"

namespace gramloom {

/// Pixel (x, y) is the mean of the image's 4×4 pixels from there on.
Image box_means(const Image& image);

/// A balanced k-d tree over an exemplar's 8×8 patches by their means of 4×4 pixels (He & Sun 2012,
/// "Computing nearest-neighbor fields via propagation-assisted kd-trees"). Node n has children
/// 2n + 1 and 2n + 2; all leaves lie at one depth, and the patches of leaf l are those from
/// count·l/leaves on.
class PatchTree {
 public:
  explicit PatchTree(const Image& exemplar);

  PatchOrigin origin(std::int64_t place) const {
    const int patch = patches_[static_cast<std::size_t>(place)];
    return {patch % origins_.width, patch / origins_.width};
  }
  std::int64_t first_of(std::int64_t leaf) const {
    return static_cast<std::int64_t>(patches_.size()) * leaf / leaves_;
  }
  /// The leaf in which the patch at (x, y) of another image's box means would lie.
  std::int64_t leaf(const Image& means, int x, int y) const;

 private:
  struct Node {
    std::size_t box = 0;
    float value = 0;
  };

  std::size_t widest_box(const Image& means, std::int64_t begin, std::int64_t end) const;
  void split(const Image& means, std::int64_t node, std::int64_t first_leaf,
             std::int64_t last_leaf);

  Size origins_;
  std::int64_t leaves_ = 1;
  std::vector<int> patches_;
  std::vector<Node> nodes_;
};

}  // namespace gramloom
