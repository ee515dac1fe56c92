#include "jobs/lesson_run.h"

#include "io/safetensors.h"
#include "io/text_file.h"
#include "jobs/memory.h"
#include "jobs/trace_log.h"
#include "learnt/model_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

bool is_trained(const fs::path& model, const std::string& identity) {
  std::error_code ignored;
  if (!fs::exists(model, ignored)) return false;
  try {
    const auto metadata = read_metadata(model);
    const auto found = metadata.find("identity");
    return found != metadata.end() && found->second == identity;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

fs::path model_of(const JobFiles& files) { return files.folder / (files.name + ".safetensors"); }

bool is_trained_before(const LessonRun& run, const std::string& identity) {
  if (!run.options.resume || !is_trained(model_of(run.files), identity)) return false;
  run.bar.message(fmt::format("{}: trained before", run.lesson.name));
  return true;
}

void refuse_without_memory(const Cost& cost, std::string_view advice) {
  if (cost.bytes > available_memory())
    throw Error("training needs about {:.1f} GB of memory, {:.1f} GB are free; {}",
                cost.bytes / 1e9, available_memory() / 1e9, advice);
}

double run_training(const LessonRun& run, const std::string& identity,
                    const std::function<void(const Control&)>& train) {
  TraceLog trace(run.files.checkpoint_trace, identity);
  if (!run.options.resume || !trace.continues() || !fs::exists(run.files.checkpoint)) {
    trace.restart();
    remove_file(run.files.checkpoint);
  }
  Control control;
  control.checkpoint = run.files.checkpoint;
  control.identity = identity;
  control.progress = [&](const Progress& progress) {
    trace.add(progress);
    run.bar.update(progress);
    return !(run.options.stop && run.options.stop());
  };
  train(control);
  write_text(run.files.trace, to_csv(trace.trace()));
  remove_unfinished_state(run.files);
  return trace.seconds();
}

void check_replaced_model(const fs::path& model) {
  std::error_code ignored;
  if (!fs::exists(model, ignored)) return;
  try {
    model_kind(model);
  } catch (const Error&) {
    throw ConfigError("would replace {}, which no training of gramloom made",
                      model.lexically_normal().string());
  }
}

}  // namespace gramloom
