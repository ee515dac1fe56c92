#pragma once

#include <optional>

#include "core/random.h"
#include "core/request.h"

namespace gramloom {

/// Weights of exemplars that are everywhere the same (a channel an exemplar, 1×1), for methods that
/// take each place of one exemplar: of the target's size, 1 for one exemplar of each pixel and 0
/// for the others. Places of one exemplar are islands a few patches wide, and each has its share of
/// the pixels that are made.
Image labels_of_shares(const Target& target, Random random);

/// The request with such labels in place of weights of several exemplars that are everywhere the
/// same: as a guide these would choose the largest of them everywhere. None where there are none.
std::optional<Request> with_labels(const Request& request);

}  // namespace gramloom
