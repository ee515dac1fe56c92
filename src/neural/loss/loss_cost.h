#pragma once

#include "core/cost.h"
#include "neural/network/work.h"

namespace gramloom {

/// What the cost of a term depends on: the pictures of the finest level, and what a network does
/// with them (nothing, where no term looks at one).
struct LossSize {
  double exemplar = 0, result = 0;  // pixels
  int channels = 0;
  int directions = 0;  // NeuralParams::directions
  NetworkWork of_exemplar, of_result;

  double values() const { return result * channels; }
};

/// Of one evaluation with its gradient. A term that looks at a network counts what it does with the
/// maps; the maps themselves are counted once for all of them.
struct LossCost {
  Work work;
  double bytes = 0;  // beyond the pictures, while this term is evaluated
};

// Measured; of one thread (Work::shared).
inline constexpr double seconds_per_sorted_value = 9e-9;
inline constexpr double seconds_per_counted_value = 7.5e-10;
inline constexpr double seconds_per_transformed_value = 7.5e-8;
/// Patches are gathered and spread, too: their products take as long as so many times as many.
inline constexpr double operations_per_patch_operation = 1.8;

}  // namespace gramloom
