#pragma once

#include <cstdint>
#include <functional>

#include "classic/exemplar_quota.h"
#include "classic/patch_grid.h"
#include "classic/quilt_direction.h"
#include "classic/quilt_guide.h"
#include "classic/seam_graph.h"
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

/// What patches are taken from, and what tells where they belong: either may be null.
struct QuiltMaterial {
  const Image& exemplar;
  const QuiltDirection* direction = nullptr;
  const QuiltGuide* guide = nullptr;
  ExemplarQuota quota = {};
  int quota_factor = 1;  // columns of the quota's picture for one of the exemplar
};

struct Quilt {
  Image canvas;
  SourceMap source;  // of each pixel: the piece that it is of; where two blend, the stronger one's
  double error = 0;  // of the patches when they were laid, per pixel in terms of the variance
};

/// Called with the number of patches that are laid; may throw.
using QuiltReport = std::function<void(std::int64_t laid)>;

/// Lays the patches of a grid, which fit into the exemplar.
Quilt lay_quilt(const QuiltMaterial& material, const PatchAxis& x, const PatchAxis& y,
                const QuiltRules& rules, Random random, const QuiltReport& report);

/// Lays those patches of the grid over a quilt that cover bare ground, row by row, and takes from
/// them what is bare and, up to a cut, what is laid. What is firm stays, and counts as the part of
/// a patch that overlaps, less with its distance from the rest.
void fill_quilt(Quilt& quilt, std::vector<Ground> ground, const QuiltMaterial& material,
                const PatchAxis& x, const PatchAxis& y, const QuiltRules& rules, Random random,
                const QuiltReport& report);

}  // namespace gramloom
