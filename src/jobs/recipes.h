#pragma once

#include <tuple>
#include <variant>

#include "jobs/frame_sequence.h"
#include "train/generator_recipe.h"
#include "train/inference_recipe.h"

namespace gramloom {

/// An inference to train, and the sequence that it makes then. The model depends on the former
/// alone.
struct InferenceTask : InferenceRecipe, FrameSequence {
  static constexpr auto fields() {
    return std::tuple_cat(InferenceRecipe::fields(), FrameSequence::fields());
  }
};

/// Every kind of model that `gramloom train` trains: the one list of them.
using ModelRecipe = std::variant<GeneratorRecipe, InferenceTask>;

}  // namespace gramloom
