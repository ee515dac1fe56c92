#pragma once

#include "neural/network/feature_maps.h"

namespace gramloom::neural {

/// The gradient of a convolution's loss with respect to its input, for pictures of few channels:
///   result[i][y + ky·dilation][x + kx·dilation] += Σ_o weights[o][i][ky][kx] · upstream[o][y][x].
/// upstream: blocked maps (blocks, height, width, block) of the outputs; weights: (outputs, inputs,
/// kernel, kernel); the result: (inputs, height + span, width + span). A matrix product for every
/// few rows and a sum of its shifted rows: oneDNN has no fast way for filters that are spread wide
/// over few channels (it takes 7 s for 48 filters of 7×7 at distance 16 on 256×256, this 15 ms).
at::Tensor plane_gradient(const at::Tensor& upstream, const at::Tensor& weights,
                          std::int64_t dilation);

}  // namespace gramloom::neural
