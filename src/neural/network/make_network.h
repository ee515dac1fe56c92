#pragma once

#include "neural/network/network.h"

namespace gramloom::neural {

/// The network with its weights, random (rescaled on the exemplar, or the middle of a large one,
/// where asked for) or from a file.
/// exemplar: (channels, height, width), as the network sees it. Throws Error when the file does
/// not have what the network needs.
Network make_network(const NeuralParams& params, const NetworkDescription& description,
                     const at::Tensor& exemplar);

}  // namespace gramloom::neural
