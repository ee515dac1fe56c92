#include "jobs/training.h"

#include <algorithm>
#include <optional>

#include "io/text_file.h"
#include "jobs/folder_lock.h"
#include "jobs/generator_lessons.h"
#include "jobs/inference_lessons.h"
#include "jobs/input_files.h"
#include "jobs/machine_speed.h"
#include "jobs/output_guard.h"
#include "jobs/plan.h"
#include "jobs/text_table.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

void train(const LessonRun& run) {
  if (is_inference(run.config, run.lesson))
    train_inference_lesson(run);
  else
    train_generator_lesson(run);
}

std::vector<MethodEntry> methods_of(const Config& config, const Lesson& lesson,
                                    const JobFiles& files) {
  if (is_inference(config, lesson)) return {};
  return methods_of_generator(config, lesson, files);
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

}  // namespace

std::vector<Expectation> expected_lessons(const Config& config, const std::string& only) {
  check_lesson_names(config);
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
  check_lesson_names(config);
  const std::vector<Lesson> lessons = lessons_of(config, options.only);
  if (lessons.empty())
    throw ConfigError("--only {}: no model of {} matches (there are {})", options.only,
                      config.file.string(), fmt::join(lesson_names(config), ", "));
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
