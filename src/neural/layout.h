#pragma once

#include <ATen/ATen.h>

#include "core/image.h"

namespace gramloom::neural {

/// The strongest correlation between two pictures (channels, height, width) laid over each other,
/// each less its mean colour, over all shifts of more than `beyond` positions on an axis at which
/// at least a quarter of the smaller one is covered.
double strongest_correlation(const at::Tensor& picture, const at::Tensor& exemplar,
                             std::int64_t beyond = -1);

/// How much more a picture correlates with the exemplar than the exemplar with itself, moved by a
/// sixth of its side or more. Of textures this is 0.1 at most; more, and the picture has the
/// exemplar's layout. What is regular, or smooth all over, does not count as a copy.
/// wraps: the edges across which the picture goes on.
double layout_copied(const at::Tensor& picture, const at::Tensor& exemplar, Tile wraps);

}  // namespace gramloom::neural
