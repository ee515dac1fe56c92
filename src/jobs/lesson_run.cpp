#include "jobs/lesson_run.h"

#include "io/safetensors.h"
#include "io/text_file.h"
#include "jobs/memory.h"
#include "jobs/trace_log.h"
#include "learnt/model_file.h"
#include "runs/samples.h"

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

bool is_model(const fs::path& file) {
  try {
    model_kind(file);
    return true;
  } catch (const Error&) {
    return false;
  }
}

bool is_trace(const fs::path& file) {
  try {
    const std::string text = read_text(file);
    return text == to_csv(Trace{}) || !parse_trace(text).rows.empty();  // of no steps, or some
  } catch (const Error&) {
    return false;
  }
}

[[noreturn]] void refuse_foreign(const fs::path& file) {
  throw Error("would replace {}, which no training of gramloom made",
              file.lexically_normal().string());
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
    for (const Sample& sample : samples_in(run.files.folder, run.files.name))
      remove_file(sample.file);  // of one before
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

void check_outputs(const JobFiles& files, const ProtectedFiles& inputs) {
  const fs::path model = model_of(files);
  for (const fs::path& file : {model, files.trace, files.checkpoint, files.checkpoint_trace})
    inputs.check(file);
  std::error_code ignored;
  if (fs::exists(model, ignored) && !is_model(model)) refuse_foreign(model);
  if (fs::exists(files.trace, ignored) && !is_trace(files.trace)) refuse_foreign(files.trace);
  for (const Sample& sample : samples_in(files.folder, files.name))
    check_replaced(sample.file, inputs, "gramloom:settings");
}

}  // namespace gramloom
