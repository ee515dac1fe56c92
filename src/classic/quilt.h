#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "classic/overlap.h"
#include "classic/patch_grid.h"
#include "classic/patch_origin.h"
#include "core/image.h"
#include "core/random.h"

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

/// How patches are chosen and joined; see the fields of QuiltingParams.
struct QuiltRules {
  double tolerance = 0;
  int candidates = 1;
  double variety = 0;
  double guidance = 0;
  int feather = 0;
};

struct Quilt {
  Image canvas;
  double error = 0;  // of the patches when they were laid, per pixel in terms of the variance
};

/// Lays the patches of a grid, which fit into the exemplar; `guide` may be null. Calls `report`
/// with the number of patches that are laid, which may throw.
Quilt lay_quilt(const Image& exemplar, const PatchAxis& x, const PatchAxis& y,
                const QuiltRules& rules, const QuiltGuide* guide, Random random,
                const std::function<void(std::int64_t laid)>& report);

/// The canvas of the one with the least error among `attempts` quilts.
Image best_quilt(const Image& exemplar, const PatchAxis& x, const PatchAxis& y,
                 const QuiltRules& rules, int attempts, Random random);

}  // namespace gramloom
