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
/// same rank. Draws from LibTorch's random numbers. `wraps`: patches go around the pictures' edges.
at::Tensor sliced_distance(const at::Tensor& pictures, const at::Tensor& exemplar, int directions,
                           int patch_size, bool wraps);

/// That of a level's pictures, and at 1/2 and 1/4 on the two coarser ones. `exemplar`: the pyramid,
/// the coarsest first.
at::Tensor sliced_distance_of_levels(const at::Tensor& pictures,
                                     const std::vector<at::Tensor>& exemplar, int level,
                                     int directions, int patch_size);

}  // namespace gramloom::train
