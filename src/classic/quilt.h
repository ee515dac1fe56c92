#pragma once

#include <cstdint>
#include <functional>

#include "classic/patch_grid.h"
#include "classic/quilt_guide.h"
#include "core/random.h"
#include "core/request.h"

namespace gramloom {

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
  SourceMap source;  // of each pixel: the piece that it is of; where two blend, the stronger one's
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
