#include "jobs/lessons.h"

#include <algorithm>
#include <set>

#include "jobs/names.h"
#include "jobs/pattern.h"
#include "jobs/plan.h"
#include "jobs/text_table.h"

namespace gramloom {

namespace {

std::vector<Lesson> all_lessons(const Config& config) {
  std::vector<Lesson> lessons;
  for (std::size_t m = 0; m < config.models.size(); ++m) {
    const std::string& name = config.models[m].name;
    if (std::holds_alternative<InferenceTask>(config.models[m].recipe)) {
      lessons.push_back({m, {}, name});
      continue;
    }
    const auto& recipe = std::get<GeneratorRecipe>(config.models[m].recipe);
    std::vector<std::size_t> wanted;
    for (std::size_t e = 0; e < config.exemplars.size(); ++e)
      if (recipe.exemplars.empty() ||
          std::ranges::count(recipe.exemplars, config.exemplars[e].name))
        wanted.push_back(e);
    if (recipe.blend)
      lessons.push_back({m, wanted, name});
    else
      for (const std::size_t e : wanted)
        lessons.push_back({m, {e}, fmt::format("{}_{}", config.exemplars[e].name, name)});
  }
  return lessons;
}

// Whether its name is one that --only means, or that of a job of its textures.
bool is_wanted(const Config& config, const Lesson& lesson, const std::string& only) {
  const std::string& model = config.models[lesson.model].name;
  if (lesson.exemplars.empty()) return only.empty() || matches(only, model);
  for (const std::size_t exemplar : lesson.exemplars)
    for (const int seed : config.seeds)
      if (job_matches(only,
                      fmt::format("{}/{}/seed{}", config.exemplars[exemplar].name, model, seed)))
        return true;
  return false;
}

}  // namespace

bool is_inference(const Config& config, const Lesson& lesson) {
  return std::holds_alternative<InferenceTask>(config.models[lesson.model].recipe);
}

std::vector<Lesson> lessons_of(const Config& config, const std::string& only) {
  std::vector<Lesson> lessons = all_lessons(config);
  std::erase_if(lessons, [&](const Lesson& lesson) { return !is_wanted(config, lesson, only); });
  return lessons;
}

std::vector<std::string> lesson_names(const Config& config) {
  std::vector<std::string> names;
  for (const Lesson& lesson : all_lessons(config)) {
    const std::string& model = config.models[lesson.model].name;
    if (lesson.exemplars.empty()) names.push_back(model);
    for (const std::size_t exemplar : lesson.exemplars)
      names.push_back(fmt::format("{}/{}", config.exemplars[exemplar].name, model));
  }
  return names;
}

void check_lesson_names(const Config& config) {
  std::set<std::string> names;
  for (const Lesson& lesson : all_lessons(config)) {
    const std::string& place = config.models[lesson.model].place;
    if (!names.insert(in_small_letters(lesson.name)).second)
      throw ConfigError("{}: two models would be called '{}': rename one", place, lesson.name);
    if (lesson.name.size() + std::string_view(".checkpoint.csv").size() > longest_file_name)
      throw ConfigError("{}: the name '{}' is too long for a file", place, lesson.name);
  }
}

}  // namespace gramloom
