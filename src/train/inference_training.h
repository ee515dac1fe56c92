#pragma once

#include <functional>
#include <vector>

#include "core/cost.h"
#include "core/progress.h"
#include "learnt/inference_model.h"
#include "train/inference_recipe.h"

namespace gramloom {

/// What an inference learns: pairs of a pose and a picture. `description` says what poses and
/// pictures are; sizes of the network and recipe are filled in by the training.
struct InferenceLesson {
  InferenceRecipe recipe;
  std::vector<std::vector<double>> poses;
  std::vector<Image> pictures;  // of one size and number of channels
  InferenceDescription description;
};

/// A state on the way: the model as it is after `step` of `steps`.
struct InferenceState {
  const InferenceModel& model;
  int step = 0;
  int steps = 0;
};
/// Looks at a state, and says how good it is on pairs that are not in the lesson: less is better.
/// The best state is kept.
using InferenceJudge = std::function<double(const InferenceState&)>;

/// The axes on which pictures go on at the opposite edge: in all of them together, first and last
/// pixels differ about as little as the pixels beside them do.
Tile wrapping_axes(const std::vector<Image>& pictures);

/// Throws ConfigError for what is out of range.
void check_recipe(const InferenceRecipe& recipe);

/// The trained model. With `control.checkpoint` it goes on from where it stopped, to the same bytes
/// as uninterrupted (for the same number of threads). Throws ConfigError for a recipe out of range,
/// Interrupted when the progress says stop.
InferenceModel train_inference(const InferenceLesson& lesson, const Control& control,
                               const InferenceJudge& judge);

/// How many numbers a pose has, pictures, and pairs: what a training costs by.
struct PairsSize {
  int numbers = 1;
  Size size;
  int channels = 1;
  std::size_t learnt = 0;
  std::size_t chosen_by = 0;  // inferred at each look of the judge
  std::size_t inferred = 0;   // afterwards: what is tested, and frames of a sequence
};

/// What a training is expected to need, with all that is inferred. Throws ConfigError for a recipe
/// out of range.
Cost estimate_training(const InferenceRecipe& recipe, const PairsSize& pairs);

}  // namespace gramloom
