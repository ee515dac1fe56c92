#include "jobs/training.h"

#include <algorithm>
#include <optional>
#include <set>

#include "io/text_file.h"
#include "jobs/folder_lock.h"
#include "jobs/generator_lessons.h"
#include "jobs/inference_lessons.h"
#include "jobs/input_files.h"
#include "jobs/machine_speed.h"
#include "jobs/names.h"
#include "jobs/output_guard.h"
#include "jobs/pattern.h"
#include "jobs/plan.h"
#include "jobs/text_table.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

bool is_inference(const Config& config, const Lesson& lesson) {
  return std::holds_alternative<InferenceTask>(config.models[lesson.model].recipe);
}

void train(const LessonRun& run) {
  if (is_inference(run.config, run.lesson))
    train_inference_lesson(run);
  else
    train_generator_lesson(run);
}

// Files of two lessons are not the same, and no name is too long for one.
void check_names(const Config& config, const std::vector<Lesson>& lessons) {
  std::set<std::string> names;
  for (const Lesson& lesson : lessons) {
    const std::string& place = config.models[lesson.model].place;
    if (!names.insert(in_small_letters(lesson.name)).second)
      throw ConfigError("{}: two models would be called '{}': rename one", place, lesson.name);
    if (lesson.name.size() + std::string_view(".checkpoint.csv").size() > longest_file_name)
      throw ConfigError("{}: the name '{}' is too long for a file", place, lesson.name);
  }
}

std::vector<MethodEntry> methods_of(const Config& config, const Lesson& lesson,
                                    const JobFiles& files) {
  if (is_inference(config, lesson)) return {};
  return methods_of_generator(config, lesson, files);
}

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

// What a training is expected to take. Throws Error for what keeps it from beginning.
Cost estimate_lesson(const Config& config, const Lesson& lesson) {
  return is_inference(config, lesson) ? estimate_inference_lesson(config.models[lesson.model])
                                      : estimate_generator_lesson(config, lesson);
}

// Whether all went well. Else it is counted and told, and others go on. Throws Interrupted.
template <class Action>
bool or_failed(const Lesson& lesson, ProgressBar& bar, Trained& trained, const Action& action) {
  const auto failed = [&](const std::string& why) {
    ++trained.failed;
    bar.complaint(fmt::format("{}: failed: {}", lesson.name, why));
    return false;
  };
  try {
    action();
    return true;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    return failed("out of memory");
  } catch (const std::exception& error) {
    return failed(first_line(error.what()));
  }
}

// Those that can be trained, found before the first one begins, which may take an hour.
std::vector<Lesson> without_impossible(const Config& config, const std::vector<Lesson>& lessons,
                                       const RunOptions& options, ProgressBar& bar,
                                       Trained& trained) {
  std::vector<Lesson> possible;
  for (const Lesson& lesson : lessons) {
    if (options.stop && options.stop()) throw Interrupted();
    if (or_failed(lesson, bar, trained, [&] { estimate_lesson(config, lesson); }))
      possible.push_back(lesson);
  }
  return possible;
}

// As --only means them.
std::vector<std::string> model_names(const Config& config) {
  std::vector<std::string> names;
  for (const Lesson& lesson : all_lessons(config)) {
    const std::string& model = config.models[lesson.model].name;
    if (lesson.exemplars.empty()) names.push_back(model);
    for (const std::size_t exemplar : lesson.exemplars)
      names.push_back(fmt::format("{}/{}", config.exemplars[exemplar].name, model));
  }
  return names;
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

std::vector<Lesson> lessons_of(const Config& config, const std::string& only) {
  std::vector<Lesson> lessons = all_lessons(config);
  std::erase_if(lessons, [&](const Lesson& lesson) { return !is_wanted(config, lesson, only); });
  return lessons;
}

std::vector<Expectation> expected_lessons(const Config& config, const std::string& only) {
  check_names(config, lessons_of(config));
  std::vector<Expectation> expected;
  std::optional<Speed> speed;
  for (const Lesson& lesson : lessons_of(config, only)) {
    const ModelEntry& model = config.models[lesson.model];
    if (is_inference(config, lesson)) check_frames(model);
    try {
      const Cost cost = estimate_lesson(config, lesson);
      if (!speed) speed = machine_speed(true);
      expected.push_back({lesson.name, cost.bytes, seconds(cost.work, *speed), ""});
    } catch (const Error& error) {
      expected.push_back({lesson.name, {}, {}, "cannot be trained: " + first_line(error.what())});
    }
  }
  return expected;
}

Trained train_models(const Config& config, const RunOptions& options, ProgressBar& bar) {
  Trained trained;
  check_names(config, lessons_of(config));
  const std::vector<Lesson> lessons = lessons_of(config, options.only);
  if (lessons.empty())
    throw ConfigError("--only {}: no model of {} matches (there are {})", options.only,
                      config.file.string(), fmt::join(model_names(config), ", "));
  for (const Lesson& lesson : lessons)
    if (is_inference(config, lesson)) check_frames(config.models[lesson.model]);
  const fs::path folder = options.output / "models";
  std::optional<FileLock> lock;
  try {
    create_folder(folder);
    lock = lock_folder(options.output);
    if (options.is_default_output) check_default_output(config, options.output);
    std::vector<InputFile> read = input_files(config);
    for (const ModelEntry& model : config.models)
      if (const auto* inference = std::get_if<InferenceTask>(&model.recipe))
        for (const fs::path& file : {inference->pairs, inference->simulation})
          if (!file.empty()) read.push_back({file, "the config reads"});
    const ProtectedFiles inputs(read);
    for (const Lesson& lesson : lessons) {
      const JobFiles files = job_files(options.output, "models/" + lesson.name);
      check_outputs(files, inputs);
      if (is_inference(config, lesson))
        check_frame_files(config.models[lesson.model], files, inputs);
    }
  } catch (const Error& error) {
    throw ConfigError("--output {}: {}", options.output.string(), error.what());
  }
  FileHashes hashes;
  try {
    const auto possible = without_impossible(config, lessons, options, bar, trained);
    for (std::size_t i = 0; i < possible.size(); ++i) {
      const Lesson& lesson = possible[i];
      const JobFiles files = job_files(options.output, "models/" + lesson.name);
      bar.start("training " + lesson.name, i + 1, possible.size());
      const LessonRun run{config, lesson, options, bar, files, hashes};
      if (!or_failed(lesson, bar, trained, [&] { train(run); })) continue;
      for (MethodEntry& method : methods_of(config, lesson, files))
        trained.methods.push_back(std::move(method));
    }
  } catch (const Interrupted&) {
    trained.interrupted = true;
  }
  return trained;
}

std::vector<MethodEntry> trained_methods(const Config& config, const fs::path& output) {
  std::vector<MethodEntry> methods;
  for (const Lesson& lesson : lessons_of(config))
    std::ranges::move(methods_of(config, lesson, job_files(output, "models/" + lesson.name)),
                      std::back_inserter(methods));
  return methods;
}

std::optional<Config> textures_of_trained(Config config, const Trained& trained,
                                          const std::string& only) {
  config.models.clear();
  config.methods.insert(config.methods.end(), trained.methods.begin(), trained.methods.end());
  const bool nothing = only.empty() ? config.methods.empty() : trained.methods.empty();
  return nothing ? std::nullopt : std::optional(std::move(config));
}

}  // namespace gramloom
