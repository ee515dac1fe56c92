#pragma once

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/progress.h"

namespace gramloom::train {

/// Throws Error where a training has diverged: more steps do not bring it back.
inline void check_finite_loss(const Progress& progress) {
  if (!std::isfinite(progress.loss) || !std::ranges::all_of(progress.terms, [](const Term& term) {
        return std::isfinite(term.value);
      }))
    throw Error("the loss is no number at step {}: take a lower learning_rate", progress.step);
}

}  // namespace gramloom::train
