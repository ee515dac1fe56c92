#pragma once

#include <torch/torch.h>

#include <vector>

namespace gramloom::train {

/// For each value of each row of `values` (rows, n) the value of the same relative rank in the same
/// row of `target` (rows, m): no gradients, the same bytes for any number of threads.
at::Tensor of_same_rank(const at::Tensor& values, const at::Tensor& target);

/// The squared sliced Wasserstein distance between the patches of pictures (batch, channels,
/// height, width), all pooled, and those of an exemplar (1, channels, …): the mean square of what
/// each patch's projection on `directions` random unit vectors differs from the exemplar's of the
/// same rank. Of an exemplar that is larger than the pictures every other patch each way counts,
/// and not a part: pictures that are a part of a texture have its statistics as a whole. Draws from
/// LibTorch's random numbers. `wraps`: patches go around the pictures' edges.
at::Tensor sliced_distance(const at::Tensor& pictures, const at::Tensor& exemplar, int directions,
                           int patch_size, bool wraps);

}  // namespace gramloom::train
