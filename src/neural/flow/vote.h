#pragma once

#include <functional>

#include "neural/flow/patch_axes.h"

namespace gramloom::neural {

/// What a pixel of a patch counts in a vote: a Gaussian about the patch's centre, of deviation
/// `spread` times its side. side × side, row by row.
std::vector<float> vote_window(int side, double spread);

/// How much pixel (u, v) of the exemplar counts at (x, y) of the picture, 0 to 1.
using Agreement = std::function<float(int x, int y, int u, int v)>;

/// Each query becomes the mean of its exemplar patches by `weights` (queries × neighbours); where
/// they overlap, the mean by the window. The picture wraps; a pixel that no patch covers is 0.
/// `agreement`, where there is one: how much the pixel of a patch counts at one of the picture; the
/// sums of queries' weights then count too, and are else 1.
/// The same bytes for any number of threads.
Image vote(Size size, const std::vector<PatchPlace>& queries, const Image& exemplar,
           const std::vector<PatchPlace>& references, const Neighbours& nearest,
           const std::vector<float>& weights, int side, const std::vector<float>& window,
           const Agreement& agreement = {});

}  // namespace gramloom::neural
