#pragma once

#include "neural/flow/patch_axes.h"

namespace gramloom::neural {

/// What a pixel of a patch counts in a vote: a Gaussian about the patch's centre, of deviation
/// `spread` times its side. side × side, row by row.
std::vector<float> vote_window(int side, double spread);

/// Each query becomes the mean of its exemplar patches by `weights` (queries × neighbours); where
/// they overlap, the mean by the window. The picture wraps; a pixel that no patch covers is 0.
/// The same bytes for any number of threads.
Image vote(Size size, const std::vector<PatchPlace>& queries, const Image& exemplar,
           const std::vector<PatchPlace>& references, const Neighbours& nearest,
           const std::vector<float>& weights, int side, const std::vector<float>& window);

}  // namespace gramloom::neural
