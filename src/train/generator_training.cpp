#include "train/generator_training.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/modules.h"
#include "train/train_module.h"

namespace gramloom {

namespace {

void check_lists(const GeneratorRecipe& recipe) {
  for_each_field<GeneratorRecipe>([&](const auto& field) {
    using T = typename std::decay_t<decltype(field)>::value_type;
    if constexpr (is_list<T> && is_number<element_t<T>>)
      if ((recipe.*field.member).empty()) throw ConfigError("{} is empty", field.name);
  });
  for (const int noise : recipe.noise)
    if (noise % 4 != 0) throw ConfigError("noise = {}: allowed are multiples of 4", noise);
  for (const int size : recipe.patch_size)
    if (size % 2 == 0) throw ConfigError("patch_size = {}: allowed are odd sizes", size);
}

Size smallest_of(const std::vector<Image>& exemplars) {
  Size size = exemplars.front().size();
  for (const Image& exemplar : exemplars)
    size = {std::min(size.width, exemplar.width), std::min(size.height, exemplar.height)};
  return size;
}

// Patches of the coarsest level, and what its discriminator sees, need some room.
int coarsest_needed(const GeneratorRecipe& recipe) {
  return 2 * std::max(recipe.patch_size.front(), 2 * recipe.adversary_layers.front() + 1);
}

}  // namespace

void check_recipe(const GeneratorRecipe& recipe) {
  check_fields(recipe);
  check_lists(recipe);
}

std::vector<GeneratorLevel> levels_of(const GeneratorRecipe& recipe, Size smallest) {
  const double side = std::min(smallest.width, smallest.height);
  int finer = std::max(0, static_cast<int>(std::lround(std::log2(side / recipe.coarsest_side))));
  while (finer > 0 && static_cast<int>(side) >> finer < coarsest_needed(recipe)) --finer;
  std::vector<GeneratorLevel> levels;
  for (int k = 0; k <= std::min(finer, 7); ++k)
    levels.push_back(
        {at_level(recipe.noise, k), at_level(recipe.hidden, k), at_level(recipe.layers, k)});
  return levels;
}

namespace {

// Throws ConfigError for what would only fail once coarser levels are trained.
void check_lesson(const GeneratorLesson& lesson) {
  const GeneratorRecipe& recipe = lesson.recipe;
  check_recipe(recipe);
  const Size smallest = smallest_of(lesson.exemplars);
  const int side = std::min(smallest.width, smallest.height);
  const int levels = static_cast<int>(levels_of(recipe, smallest).size());
  if (const int coarsest = side >> (levels - 1), needed = coarsest_needed(recipe);
      coarsest < needed)
    throw ConfigError("the exemplar is too small: it has a side of {} pixels, needed are {}",
                      coarsest, needed);
  if (at_level(recipe.steps, levels - 1) == 0)
    throw ConfigError("steps = 0 of the finest level: it would stay untrained");
  const int patch = *std::ranges::max_element(recipe.patch_size);
  for (int k = 0; k < levels; ++k) {
    const int crop = at_level(recipe.crop, k), layers = at_level(recipe.adversary_layers, k);
    if (const int needed = std::max(2 * patch, 2 * layers + 1); crop < needed)
      throw ConfigError(
          "crop = {} of level {} is too small: patches of {} pixels and a discriminator of {} "
          "layers need {}",
          crop, k + 1, patch, layers, needed);
  }
}

}  // namespace

GeneratorModel train_generator(const GeneratorLesson& lesson, const Control& control,
                               const Judge& judge) {
  check_lesson(lesson);
  GeneratorLesson whole = lesson;
  GeneratorDescription& description = whole.description;
  description.levels = levels_of(lesson.recipe, smallest_of(lesson.exemplars));
  description.channels = lesson.exemplars.front().channels;
  description.recipe = to_json_value(lesson.recipe);
  return open_module<TrainModule>().train_generator(whole, control, judge);
}

Cost estimate_training(const GeneratorLesson& lesson) {
  check_lesson(lesson);
  const auto levels = levels_of(lesson.recipe, smallest_of(lesson.exemplars));
  const int count = static_cast<int>(levels.size());
  const double side =
      std::min(smallest_of(lesson.exemplars).width, smallest_of(lesson.exemplars).height);
  Cost cost{5e8, {.serial = 1}};
  for (int k = 0; k < count; ++k) {
    const double length =
        std::min<double>(at_level(lesson.recipe.crop, k), std::ldexp(side, k - count + 1));
    const double pixels = length * length * at_level(lesson.recipe.batch, k);
    const GeneratorLevel& level = levels[static_cast<std::size_t>(k)];
    const double products = 9.0 * level.hidden * level.hidden * level.layers;
    const double steps = at_level(lesson.recipe.steps, k);
    cost.work += {.serial = 0.01 * steps,
                  .shared = 3e-6 * steps * pixels,
                  .operations = 12 * steps * pixels * products};
    cost.bytes = std::max(cost.bytes, 5e8 + pixels * (12.0 * level.hidden * level.layers +
                                                      8.0 * lesson.recipe.directions * 4));
  }
  return cost;
}

}  // namespace gramloom
