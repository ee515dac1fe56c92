#pragma once

#include "classic/quilt.h"

namespace gramloom {

/// What a quilt's pixels must be of: the guide of its target, where that is of labels.
struct QuiltLabels {
  const Exemplar& exemplar;
  const Image& guide;   // the target's
  const Image& weight;  // as Target::guide_weight
  Tile tile = Tile::none;
};

/// Patches are rectangles and labels are not: pixels whose guide is plainly further from the
/// target's than the best one of the exemplar are made once more, of smaller and smaller patches
/// that must fit these pixels alone; what is left at the end, pixel by pixel. So hard labels are
/// honoured exactly. Where the exemplar's guide has many different values there are no labels, and
/// nothing is done.
/// `mask`: which pixels may be made anew; empty: all. `patch`: of the quilt.
void keep_labels(Quilt& quilt, const QuiltLabels& labels, const Image& mask, Size patch,
                 double overlap, const QuiltRules& rules, Random random, const QuiltReport& report);

}  // namespace gramloom
