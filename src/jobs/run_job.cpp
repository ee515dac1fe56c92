#include "jobs/run_job.h"

#include "core/hash.h"
#include "io/text_file.h"
#include "jobs/interruption.h"
#include "jobs/memory.h"
#include "jobs/results.h"
#include "jobs/trace_log.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

JobRecord new_record(const Run& run, const Job& job) {
  JobRecord record;
  record.exemplar = exemplar_name(run.config, job);
  record.method = run.config.methods[job.method].name;
  record.kind = kind_of(run.config.methods[job.method].method);
  record.seed = job.seed;
  record.size = run.config.size;
  record.settings = job_settings(run.config, run.plan, job);
  record.error = "stopped before it was finished";
  return record;
}

void refuse_if_impossible(const Run& run, const PlannedJob& planned) {
  if (!planned.error.empty()) throw Error("{}", planned.error);
  const std::string refusal = memory_refusal(run.config, run.plan, planned, available_memory());
  if (!refusal.empty()) throw Error("{}", refusal);
}

// The texture, and whether the user stopped the work before it was finished.
struct Made {
  Texture texture;
  bool stopped = false;
};

Made make_texture(Run& run, const PlannedJob& planned, const JobFiles& files, TraceLog& trace) {
  const Job& job = planned.job;
  Made made;
  Control control;
  control.checkpoint = files.checkpoint;
  control.progress = [&](const Progress& progress) {
    trace.add(progress);
    run.bar.update(progress);
    made.stopped = run.stopped();
    return !made.stopped;
  };
  std::optional<NothingToKeep> scope;
  if (!std::holds_alternative<NeuralParams>(run.config.methods[job.method].method)) scope.emplace();
  made.texture = run_method(run.config.methods[job.method].method, request_of(run, job), control);
  return made;
}

void write_results(const Run& run, const JobFiles& files, Texture joined, const TraceLog& trace,
                   JobRecord& record) {
  const Texture texture = split_layers(std::move(joined), run.files);
  record.files = write_texture(files.folder, files.name, texture,
                               output_formats(run.config, run.files, texture), record.settings);
  record.loss = summarise(trace.trace());
  if (record.loss)
    write_text(files.trace, to_csv(trace.trace()));
  else
    remove_file(files.trace);
  remove_file(files.copy_map);  // of the texture before
  write_record(files.record, record);
}

// Does the job and writes its files; throws what goes wrong.
void do_job(Run& run, const PlannedJob& planned, const JobFiles& files, bool keep_old,
            JobRecord& record) {
  refuse_if_impossible(run, planned);
  TraceLog trace(files.checkpoint_trace, hash_of(record.settings.dump()));
  if (!run.options.resume || !trace.continues() || !exists(files.checkpoint)) {
    trace.restart();
    remove_file(files.checkpoint);
  }
  reset_peak_memory();
  Made made = make_texture(run, planned, files, trace);
  record.seconds = trace.seconds();
  record.peak_memory_mb = peak_memory() / 1e6;
  if (made.stopped && keep_old) return;
  if (!made.stopped) {
    record.status = Status::done;
    record.error.clear();
  }
  write_results(run, files, std::move(made.texture), trace, record);
  if (!made.stopped) remove_unfinished_state(files);
}

}  // namespace

const Request& request_of(Run& run, const Job& job) {
  if (run.loaded != job.exemplar) {
    const NothingToKeep scope;
    run.loaded.reset();
    run.request.exemplars.clear();
    run.files.clear();
    run.statistics.reset();
    if (job.exemplar) {
      LoadedExemplar loaded = load_exemplar(run.config.exemplars[*job.exemplar]);
      run.request.exemplars.push_back(std::move(loaded.exemplar));
      run.files = std::move(loaded.files);
    }
    run.loaded = job.exemplar;
  }
  run.request.target = {run.config.size, run.config.tile};
  // The seed alone: a texture does not change when its exemplar or method is given another name.
  run.request.random = Random(static_cast<std::uint64_t>(job.seed));
  return run.request;
}

ExemplarStatistics& statistics_of(Run& run, const Job& job) {
  const Exemplar& exemplar = request_of(run, job).exemplars.front();
  if (!run.statistics) run.statistics.emplace(picture_of(exemplar));
  return *run.statistics;
}

Control shown_work(Run& run) {
  Control control;
  control.progress = [&run](const Progress& progress) {
    run.bar.update(progress);
    return !run.stopped();
  };
  return control;
}

JobRecord run_job(Run& run, const PlannedJob& planned) {
  const JobFiles files = job_files(run.options.output, planned.name);
  JobRecord record = new_record(run, planned.job);
  const auto fail = [&](const std::string& why) {
    record.status = Status::failed;
    record.error = first_line(why);
    try {
      write_record(files.record, record);
    } catch (const Error&) {
      // The disk may be what failed; the terminal says so.
    }
  };
  const std::optional<JobRecord> before = read_record(files.record);
  const bool keep_old = is_finished(before, files.folder);
  try {
    create_folder(files.folder);
    remove_stale_temporaries(files);
    if (!keep_old) write_record(files.record, record);
    do_job(run, planned, files, keep_old, record);
    if (before && record.status == Status::done)
      remove_replaced(files, before->files, record.files);
  } catch (const Interrupted&) {
    record.status = Status::interrupted;
  } catch (const std::bad_alloc&) {
    fail("out of memory");
  } catch (const std::exception& error) {
    fail(error.what());
  }
  return record;
}

}  // namespace gramloom
