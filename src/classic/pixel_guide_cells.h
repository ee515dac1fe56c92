#pragma once

#include <vector>

#include "classic/pixel_levels.h"
#include "core/random.h"

namespace gramloom::pixel {

/// Samples of a level by their guide, so that ones with a wanted guide are found at random.
class GuideCells {
 public:
  GuideCells() = default;
  GuideCells(const Level& level, Random random);

  bool empty() const { return members_.empty(); }
  /// One whose guide is about this.
  int draw(const float* guide, Random& random) const;

 private:
  std::size_t nearest(const float* guide) const;

  std::size_t channels_ = 0;
  std::vector<float> centres_;  // [cell][channel]
  std::vector<std::vector<int>> members_;
};

}  // namespace gramloom::pixel
