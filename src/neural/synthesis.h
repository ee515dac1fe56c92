#pragma once

#include "core/image.h"
#include "core/progress.h"
#include "core/random.h"
#include "neural/params.h"

namespace gramloom {

/// The texture. When `control` asks to stop, what there is so far.
/// Throws ConfigError for a network, layer or weights that cannot be, Error for an exemplar too
/// small for the network.
Texture synthesise(const NeuralParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control);

/// Peak memory and time of that synthesis.
Cost estimate(const NeuralParams& params, Size exemplar, int channels, const Target& target);

}  // namespace gramloom
