#pragma once

#include <vector>

#include "core/image.h"

namespace gramloom {

/// Second moments of features of a small random network, at up to 4 scales (halved each time):
/// 16 filters of 5×5 over the components, rectified by |·|, then 32 of 3×3 over those, rectified by
/// max(0, ·); and a constant. Filters are normal numbers of a fixed seed, of mean 0 in the first
/// layer. It is held out: the filters' seed, sizes, rectifiers and scales are shared with no
/// synthesis here. Gram matrices as a measure of texture: Gatys, Ecker, Bethge 2015; random
/// filters: Ustyuzhaninov, Brendel, Gatys, Bethge 2017.
struct RandomFeatures {
  static constexpr int count = 16 + 32;
  struct Scale {
    std::vector<double> mean;    // count
    std::vector<double> moment;  // E[f_i f_j], count × count, row-major
  };
  std::vector<Scale> scales;
};

/// Of a picture of components.
RandomFeatures random_features(const Image& components);

/// The mean over the scales that both have of ‖G_x − G_e‖ / ‖G_e‖ (Frobenius), where G holds the
/// second moments of features centred and scaled as on the exemplar: 0 for equal statistics; an
/// unlike texture comes to about 1.
double gram_distance(const RandomFeatures& exemplar, const RandomFeatures& image);

}  // namespace gramloom
