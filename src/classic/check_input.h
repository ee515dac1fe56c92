#pragma once

#include "core/image.h"

namespace gramloom {

/// What every synthesis from an exemplar asks of its input. Throws Error when the exemplar is
/// empty, has more than 64 channels or holds a value that is not finite or beyond ±1e15, or when
/// the wanted size is not positive.
void check_input(const Image& exemplar, const Target& target);

}  // namespace gramloom
