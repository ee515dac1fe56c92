#pragma once

#include <functional>
#include <vector>

#include "core/cost.h"
#include "core/progress.h"
#include "core/request.h"
#include "learnt/generator_model.h"
#include "train/generator_recipe.h"

namespace gramloom {

/// What a generator learns: one exemplar, or several to blend. Its layers and materials stand in
/// `description`; levels, channels and recipe are filled in by the training.
struct GeneratorLesson {
  GeneratorRecipe recipe;
  std::vector<Image> exemplars;  // joined: picture and maps, the same channels in each
  GeneratorDescription description;
};

/// A state on the way: the model as it is after `step` of `steps`, with the levels begun so far.
struct TrainingState {
  const GeneratorModel& model;
  int step = 0;
  int steps = 0;
  int levels_to_come = 0;  // finer ones that the model does not have yet
};
/// Looks at a state, and says how good it is: less is better. Of the finest level's states the best
/// is kept.
using Judge = std::function<double(const TrainingState&)>;

/// Throws ConfigError for a recipe that no exemplar allows: "noise = 5: …".
void check_recipe(const GeneratorRecipe& recipe);

/// Levels of a generator of that exemplar, the coarsest first.
std::vector<GeneratorLevel> levels_of(const GeneratorRecipe& recipe, Size smallest);

/// The trained model. With `control.checkpoint` it goes on from where it stopped, to the same bytes
/// as uninterrupted (for the same number of threads). Throws ConfigError for a recipe that the
/// exemplars don't allow, Interrupted when the progress says stop.
GeneratorModel train_generator(const GeneratorLesson& lesson, const Control& control,
                               const Judge& judge);

/// What that is expected to need.
Cost estimate_training(const GeneratorLesson& lesson);

}  // namespace gramloom
