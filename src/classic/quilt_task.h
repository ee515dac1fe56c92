#pragma once

#include "classic/quilt.h"

namespace gramloom {

struct QuiltGrid {
  PatchAxis x, y;
  Size patch() const { return {x.patch, y.patch}; }
};

/// What is to be quilted: exemplars as one, and the parts of the target, of which any may be empty.
struct QuiltTask {
  const Exemplar& exemplar;
  Size size;
  Tile tile;
  const Image& known;
  const Image& mask;
  const Image& guide;
  const Image& weight;
  ExemplarQuota quota = {};
  int quota_factor = 1;  // as QuiltMaterial

  bool directed() const { return !exemplar.mask.empty() || !guide.empty(); }
};

/// A task at a quarter of its resolution. A pixel of the target is made there where any of those
/// under it is.
struct QuarterTask {
  Exemplar exemplar;
  Image known, mask, guide, weight;
  Size size;
  Tile tile;
  ExemplarQuota quota;

  explicit QuarterTask(const QuiltTask& task);
  QuiltTask task() const {
    return {exemplar, size, tile, known, mask, guide, weight, quota, QuiltGuide::factor};
  }
};

/// A quilt of the whole target, or of what is to be made of it. `guide` may be null.
Quilt make_quilt(const QuiltTask& task, const QuiltGrid& grid, const QuiltRules& rules,
                 const QuiltGuide* guide, Random random, const QuiltReport& report);

/// Known pixels cannot give way to a cut: along them smaller patches, which fit better, are laid
/// over those of a quilt of this size of patch.
void mend_rim(Quilt& quilt, const QuiltTask& task, int patch, double overlap,
              const QuiltRules& rules, Random random, const QuiltReport& report);

/// The size of which each exemplar has a piece that may be used. Throws Error where it is too
/// small.
Size usable_size(const std::vector<Exemplar>& exemplars);

}  // namespace gramloom
