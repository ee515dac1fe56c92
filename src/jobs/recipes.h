#pragma once

#include <variant>

#include "train/generator_recipe.h"
#include "train/inference_recipe.h"

namespace gramloom {

/// Every kind of model that `gramloom train` trains: the one list of them.
using ModelRecipe = std::variant<GeneratorRecipe, InferenceRecipe>;

}  // namespace gramloom
