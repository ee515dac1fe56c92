#pragma once

#include "core/cost.h"
#include "core/progress.h"
#include "core/request.h"
#include "neural/params.h"

namespace gramloom {

/// The texture. When `control` asks to stop, what there is so far.
/// Throws ConfigError for a network, layer or weights that cannot be, Error for an exemplar too
/// small for the network.
Texture synthesise(const NeuralParams& params, const Request& request, const Control& control);

/// Peak memory and time of that synthesis.
Cost estimate(const NeuralParams& params, const RequestSize& request);

}  // namespace gramloom
