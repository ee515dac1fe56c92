#pragma once

#include <vector>

#include "core/image.h"

namespace gramloom {

/// Textures of one size, blended by weights: a channel for each of them, of that size. Where two
/// are averaged that don't agree, contrast is lost: so what differs from the mean is multiplied up
/// to the deviation that the average of their quantile functions would have, which is the average
/// of their deviations. Stays in the range of what is blended.
Image blended_by_weights(const std::vector<Image>& textures, const Image& weights);

}  // namespace gramloom
