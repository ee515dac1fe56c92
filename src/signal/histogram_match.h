#pragma once

#include <span>
#include <vector>

#include "core/image.h"

namespace gramloom {

/// Histogram matching by rank: the i-th smallest value becomes the i-th smallest of the exemplar.
/// Exact for continuous and for quantised values alike, unlike a lookup table over bins. Where
/// the numbers of values differ, the exemplar's quantile function is interpolated linearly between
/// its values, each standing for the middle of its share: rank (i + ½)/n of the result is rank
/// (j + ½)/m of the exemplar. Equal values keep their order in memory (so a flat image gets all
/// of the exemplar's values, in ascending order). Values must be finite.

/// The values in ascending order (−0 counts as 0).
std::vector<float> sorted_values(std::span<const float> values);

/// Gives `values` the distribution of `sorted`, which is not empty and ascends: the exemplar's
/// side is sorted once and used for many matches.
void match_values(std::span<float> values, std::span<const float> sorted);

/// Gives each channel of `image` the distribution of the same channel of `exemplar`; the sizes may
/// differ. Throws Error when the numbers of channels differ or the exemplar is empty.
void match_histogram(Image& image, const Image& exemplar);

}  // namespace gramloom
