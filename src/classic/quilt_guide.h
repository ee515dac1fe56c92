#pragma once

#include <vector>

#include "classic/overlap.h"
#include "core/image.h"
#include "signal/patch_origin.h"

namespace gramloom {

/// What a quilt should look like at a quarter of its resolution.
class QuiltGuide {
 public:
  static constexpr int factor = 4;

  /// `canvas`, a quarter of a quilt of patches of this size, was made of `exemplar`, a quarter of
  /// the quilt's exemplar.
  QuiltGuide(const Image& exemplar, Image canvas, Size patch);

  /// errors += weight · squared distance from the guide of the whole patch at `place` of a quilt of
  /// `size`, when it is taken from each of `positions`.
  void add_to(std::vector<float>& errors, Size positions, PatchOrigin place, Size size,
              float weight) const;

 private:
  Image canvas_;
  Size patch_;
  OverlapErrors errors_;
};

}  // namespace gramloom
