#include "jobs/runner.h"

#include <unistd.h>

#include "io/text_file.h"
#include "jobs/job_files.h"
#include "jobs/memory.h"
#include "jobs/plan.h"
#include "jobs/record.h"
#include "jobs/results.h"
#include "jobs/run_file.h"
#include "jobs/trace.h"
#include "neural/blas_speed.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// What all jobs of a run share. The exemplar of the last job is kept for the next one.
struct Run {
  const Config& config;
  const RunOptions& options;
  const Plan& plan;
  ProgressBar& bar;
  std::optional<std::size_t> loaded;
  ImageFile exemplar;

  bool stopped() const { return options.stop && options.stop(); }
};

const ImageFile& exemplar_of(Run& run, const Job& job) {
  if (run.loaded != job.exemplar) {
    run.exemplar = {};
    if (job.exemplar) run.exemplar = load_exemplar(run.config.exemplars[*job.exemplar]);
    run.loaded = job.exemplar;
  }
  return run.exemplar;
}

// The first line of what went wrong: libraries like to add a stack trace.
std::string one_line(const std::string& text) { return text.substr(0, text.find('\n')); }

JobRecord new_record(const Run& run, const Job& job) {
  JobRecord record;
  record.exemplar = job.exemplar ? run.config.exemplars[*job.exemplar].name : procedural_folder;
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
  // The seed alone: a texture does not change when its exemplar or method is given another name.
  made.texture = run_method(run.config.methods[job.method].method, exemplar_of(run, job).image,
                            {run.config.size, run.config.tile},
                            Random(static_cast<std::uint64_t>(job.seed)), control);
  return made;
}

void write_results(Run& run, const PlannedJob& planned, const JobFiles& files,
                   const Texture& texture, const TraceLog& trace, JobRecord& record) {
  const OutputFormat format =
      output_format(run.config, exemplar_of(run, planned.job).encoding, texture.image.channels);
  record.files = write_texture(files.folder, files.name, texture, format, record.settings);
  record.loss = summarise(trace.trace());
  if (record.loss)
    write_text(files.trace, to_csv(trace.trace()));
  else
    remove_file(files.trace);
  write_record(files.record, record);
}

// Does the job and writes its files; throws what goes wrong.
void do_job(Run& run, const PlannedJob& planned, const JobFiles& files, bool keep_old,
            JobRecord& record) {
  refuse_if_impossible(run, planned);
  // Known before the work where the exemplar says it.
  if (planned.job.exemplar) {
    const ExemplarFacts& facts = run.plan.exemplars[*planned.job.exemplar];
    output_format(run.config, facts.encoding, facts.channels);
  }
  TraceLog trace(files.checkpoint_trace, hash_of(record.settings.dump()));
  if (!run.options.resume || !trace.continues() || !exists(files.checkpoint)) {
    trace.restart();
    remove_file(files.checkpoint);
  }
  reset_peak_memory();
  const Made made = make_texture(run, planned, files, trace);
  record.seconds = trace.seconds();
  record.peak_memory_mb = peak_memory() / 1e6;
  if (made.stopped && keep_old) return;
  if (!made.stopped) {
    record.status = Status::done;
    record.error.clear();
  }
  write_results(run, planned, files, made.texture, trace, record);
  if (!made.stopped) remove_unfinished_state(files);
}

std::string outcome(const PlannedJob& planned, const JobRecord& record) {
  if (record.status == Status::failed)
    return fmt::format("{}: failed: {}", planned.name, record.error);
  std::string text =
      fmt::format("{}: {} in {:.1f} s", planned.name, to_word(record.status), record.seconds);
  if (record.loss) text += fmt::format(", loss {:.3e}", record.loss->last);
  return text;
}

// The job's record, after all its files are on disk.
JobRecord run_job(Run& run, const PlannedJob& planned, std::size_t number, std::size_t count) {
  const JobFiles files = job_files(run.options.output, planned.name);
  JobRecord record = new_record(run, planned.job);
  const auto fail = [&](const std::string& why) {
    record.status = Status::failed;
    record.error = one_line(why);
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
    run.bar.start(planned.name, number, count);
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
  if (record.status == Status::failed)
    run.bar.complaint(outcome(planned, record));
  else
    run.bar.message(outcome(planned, record));
  return record;
}

// Whether --resume finds the job finished; says why when it does not.
bool skip_finished(Run& run, const PlannedJob& planned) {
  const JobFiles files = job_files(run.options.output, planned.name);
  const auto before = read_record(files.record);
  const std::string reason =
      reason_to_run(before, job_settings(run.config, run.plan, planned.job), files.folder);
  if (reason.empty()) {
    remove_unfinished_state(files);
    run.bar.message(fmt::format("{}: finished before", planned.name));
  } else if (before) {
    run.bar.message(fmt::format("{}: again, {}", planned.name, reason));
  }
  return reason.empty();
}

// A folder that can be written, with run.json in it, or a ConfigError.
RunFile prepare_output(const Config& config, const Plan& plan, const fs::path& output) {
  try {
    create_folder(output);
    return RunFile(config, plan, output);
  } catch (const Error& error) {
    throw ConfigError("--output {}: {}", output.string(), error.what());
  }
}

// A slow BLAS is no mistake, but a neural job that takes ten times as long deserves a word.
void warn_of_slow_blas(const Run& run) {
  const auto is_neural = [&](const PlannedJob& planned) {
    return planned.selected &&
           std::holds_alternative<NeuralParams>(run.config.methods[planned.job.method].method);
  };
  if (std::none_of(run.plan.jobs.begin(), run.plan.jobs.end(), is_neural)) return;
  if (const double speed = blas_gigaflops(); speed < slow_blas_gigaflops)
    run.bar.complaint(
        fmt::format("warning: matrix products run at {:.0f} GFLOP/s, so neural jobs will be slow: "
                    "install OpenBLAS (Debian: libopenblas0-openmp)",
                    speed));
}

void count_outcome(RunSummary& summary, Status status) {
  switch (status) {
    case Status::done:
      ++summary.done;
      break;
    case Status::failed:
      ++summary.failed;
      break;
    case Status::interrupted:
      ++summary.interrupted;
      break;
  }
}

}  // namespace

RunSummary run(const Config& config, const RunOptions& options, ProgressBar& bar) {
  const Plan plan = make_plan(config, options.only);
  RunFile run_file = prepare_output(config, plan, options.output);
  Run run{config, options, plan, bar, {}, {}};
  const auto count = static_cast<std::size_t>(
      std::count_if(plan.jobs.begin(), plan.jobs.end(), [](const auto& j) { return j.selected; }));
  warn_of_slow_blas(run);
  RunSummary summary;
  std::size_t number = 0;
  for (const auto& planned : plan.jobs) {
    if (!planned.selected) continue;
    ++number;
    if (run.stopped()) {
      ++summary.left;
      continue;
    }
    if (options.resume && skip_finished(run, planned)) {
      ++summary.skipped;
      continue;
    }
    const JobRecord record = run_job(run, planned, number, count);
    count_outcome(summary, record.status);
    try {
      run_file.set(planned.name, record);
    } catch (const Error& error) {
      bar.complaint(error.what());
    }
  }
  return summary;
}

}  // namespace gramloom
