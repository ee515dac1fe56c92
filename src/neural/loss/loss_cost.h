#pragma once

#include "core/image.h"
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
  double seconds = 0;  // on two current cores
  double bytes = 0;    // beyond the pictures, while this term is evaluated
};

// Measured on two cores: what OpenBLAS and oneDNN reach over a whole evaluation, and the rest.
inline constexpr double matrix_operations_per_second = 2.2e11;
inline constexpr double patch_operations_per_second = 1.2e11;  // patches are gathered and spread
inline constexpr double seconds_per_sorted_value = 6e-9;
inline constexpr double seconds_per_counted_value = 5e-10;
inline constexpr double seconds_per_transformed_value = 5e-8;

}  // namespace gramloom
