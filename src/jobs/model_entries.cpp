#include "jobs/model_entries.h"

#include <algorithm>

#include "core/variants.h"
#include "io/toml_reader.h"
#include "jobs/exemplar_entries.h"
#include "jobs/names.h"
#include "jobs/overrides.h"
#include "train/generator_training.h"
#include "train/inference_training.h"

namespace gramloom {

namespace {

ModelRecipe read_recipe(const toml::table& table) {
  ModelRecipe recipe;
  std::vector<std::string> kinds;
  for_each_alternative<ModelRecipe>(
      [&]<class T>(std::type_identity<T>) { kinds.emplace_back(T::kind); });
  const std::size_t kind =
      index_of_word(required_text(table, "kind"), kinds, "kind", key_region(table, "kind"));
  with_alternative<ModelRecipe>(kind, [&]<class Recipe>(std::type_identity<Recipe>) {
    Recipe own;
    check_keys(table, key_names<Recipe>({"name", "kind"}));
    read_fields(own, table);
    recipe = own;
  });
  return recipe;
}

void check_entry(const GeneratorRecipe& recipe, const toml::table& table, const Config& config) {
  const auto known = [&](const std::string& name) {
    return std::any_of(config.exemplars.begin(), config.exemplars.end(),
                       [&](const ExemplarEntry& exemplar) { return exemplar.name == name; });
  };
  for (const std::string& name : recipe.exemplars)
    if (!known(name))
      fail(key_region(table, "exemplars"), "'exemplars': no exemplar is called '{}'", name);
    else if (std::ranges::count(recipe.exemplars, name) > 1)
      fail(key_region(table, "exemplars"), "'exemplars' has '{}' twice", name);
  try {
    check_recipe(recipe);
  } catch (const ConfigError& error) {
    fail(key_region(table, "kind"), "{}", error.what());
  }
  const std::size_t count =
      recipe.exemplars.empty() ? config.exemplars.size() : recipe.exemplars.size();
  if (count == 0) fail(key_region(table, "kind"), "a generator needs an [[exemplar]]");
  if (recipe.blend && (count < 2 || count > 8))
    fail(key_region(table, "blend"), "'blend' is of 2 to 8 exemplars, there are {}", count);
}

void check_entry(const InferenceTask& task, const toml::table& table, const Config&) {
  if (task.pairs.empty() == task.simulation.empty())
    fail(key_region(table, "kind"), "an inference needs either 'pairs' or 'simulation'");
  try {
    check_recipe(task);
  } catch (const ConfigError& error) {
    fail(key_region(table, "kind"), "{}", error.what());
  }
  if (task.pose.empty() && task.to.empty()) {
    for (const char* key : {"frames", "extrapolate"})
      if (table.contains(key))
        fail(key_region(table, key), "'{}' is of a sequence, which needs 'pose' and 'to'", key);
  } else if (task.pose.size() != task.to.size()) {
    fail(key_region(table, task.to.empty() ? "pose" : "to"),
         "'pose' has {} numbers, 'to' has {}: a sequence goes from one to the other",
         task.pose.size(), task.to.size());
  }
}

}  // namespace

std::vector<ModelEntry> read_models(toml::table& table, const Config& config) {
  std::vector<ModelEntry> models;
  NamesInUse names;
  for (const auto& method : config.methods) names.add(method.name, table.source());
  for (const toml::table* entry : section(table, "model")) {
    ModelEntry model;
    model.recipe = read_recipe(*entry);
    model.name = required_text(*entry, "name");
    check_name(model.name, longest_file_name, key_region(*entry, "name"));
    names.add(model.name, key_region(*entry, "name"));
    std::visit([&](const auto& recipe) { check_entry(recipe, *entry, config); }, model.recipe);
    model.place = place(entry->source());
    models.push_back(std::move(model));
  }
  for (const ExemplarEntry& exemplar : config.exemplars)
    if (!models.empty() && in_small_letters(exemplar.name) == "models")
      throw ConfigError("{}: the name 'models' is taken by the models of a training",
                        exemplar.place);
  return models;
}

void refuse_models(const Config& config, std::string_view command) {
  if (!config.models.empty())
    throw ConfigError("{}: a [[model]] is for 'gramloom train', '{}' trains none",
                      config.models.front().place, command);
}

}  // namespace gramloom
