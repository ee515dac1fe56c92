#pragma once

#include "classic/pixel_canvas.h"
#include "classic/pixel_direction.h"
#include "core/random.h"

namespace gramloom::pixel {

/// A first canvas for `level`: square blocks of the exemplar in scan order, each from where the
/// pixels already there around it fit, at random among the good places (the first step of Efros &
/// Freeman 2001, without cuts: corrections remove the seams). variety: the part by which the error
/// of a place grows for each block that already came from about there. Of a fill only blocks that
/// hold pixels to be made are laid, each time the one that most known pixels surround, from the
/// place that fits best, of two that fit alike the one that fits farther out: so rows and grids go
/// on in phase.
/// `factor`: columns of the quota's picture for a sample.
Canvas quilted_start(const Level& level, const Aim& aim, Tile tile, double variety,
                     ExemplarQuota quota, int factor, Random random);

}  // namespace gramloom::pixel
