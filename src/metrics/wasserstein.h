#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"

namespace gramloom {

// Sliced Wasserstein distances: the mean over fixed random directions of the one-dimensional
// Wasserstein-1 distance of the projections (Rabin, Peyré, Delon, Bernot 2011, "Wasserstein
// barycenter and its application to texture mixing"). 0 for equal distributions.

/// Up to `wanted` of the numbers below `count`, one at random from each of as many runs of equal
/// length (a regular sample would miss every second stripe); always the same.
std::vector<std::int64_t> spread_sample(std::int64_t count, std::int64_t wanted);

/// The mean over ranks of the distance between the quantile functions of two ascending lists, at as
/// many ranks as the shorter one has.
double quantile_distance(const std::vector<float>& a, const std::vector<float>& b);

/// A picture's projections: a list a direction, each ascending.
using Projections = std::vector<std::vector<float>>;

/// Of 7×7 patches of components at 3 scales, halved each time (Heitz et al. 2021; Elnekave & Weiss
/// 2022), along 64 directions of mean 0 in each component (colours have a score of their own, and a
/// patch's mean would drown its structure), each in the exemplar's deviations along it. Of each
/// scale 16384 patches are taken where there are more, one at random from each of as many equal
/// runs.
std::vector<Projections> patch_projections(const Image& components);  // one a scale
double patch_wasserstein(const std::vector<Projections>& exemplar,
                         const std::vector<Projections>& image);

/// Of pixels with all their channels, in units of the exemplar's total deviation (`scale` is its
/// inverse), along the channels (up to 4) and 16 more directions. Of more than 65536 pixels as many
/// are taken.
Projections colour_projections(const Image& image, double scale);
double colour_wasserstein(const Projections& exemplar, const Projections& image);

}  // namespace gramloom
