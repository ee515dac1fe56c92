#include "jobs/runner.h"

#include <algorithm>

#include "io/text_file.h"
#include "jobs/folder_lock.h"
#include "jobs/interruption.h"
#include "jobs/job_scores.h"
#include "jobs/keep_exemplar.h"
#include "jobs/output_guard.h"
#include "jobs/results.h"
#include "jobs/run_log.h"
#include "neural/blas_speed.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// What --resume finds finished; says why when it finds nothing.
std::optional<JobRecord> finished_before(Run& run, const PlannedJob& planned) {
  const JobFiles files = job_files(run.options.output, planned.name);
  const std::string reason = reason_to_run(run, planned);
  if (reason.empty()) {
    remove_unfinished_state(files);
    return find_record(files.record);
  }
  if (fs::exists(files.record)) run.bar.message(fmt::format("{}: again, {}", planned.name, reason));
  return std::nullopt;
}

Plan look_ahead(const Config& config, const RunOptions& options) {
  const NothingToKeep scope;
  return make_plan(config, options.only);
}

// A folder that can be written and is ours alone, with run.json in it, or a ConfigError.
struct Output {
  FolderLock lock;
  RunLog log;
};
Output prepare_output(const Config& config, const Plan& plan, const RunOptions& options) {
  const fs::path& output = options.output;
  try {
    create_folder(output);
    FolderLock lock(output);
    if (options.is_default_output) check_default_output(config, output);
    std::vector<InputFile> inputs = input_files(config);
    inputs.insert(inputs.end(), options.inputs.begin(), options.inputs.end());
    check_output(config, plan, output, inputs);
    for (const auto* stem : {"run", "scores", "index", "baseline"})
      remove_stale_temporaries(output, stem);
    return {std::move(lock), RunLog(config, plan, options)};
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

std::string outcome(const PlannedJob& planned, const JobRecord& record, bool before) {
  if (record.status == Status::failed)
    return fmt::format("{}: failed: {}", planned.name, record.error);
  std::string text = planned.name + ": ";
  text += before ? "finished before"
                 : fmt::format("{} in {:.1f} s", to_word(record.status), record.seconds);
  if (!before && record.loss) text += fmt::format(", loss {:.3e}", record.loss->last);
  return text;
}

void count_outcome(RunSummary& summary, Status status, bool before) {
  if (before) {
    ++summary.skipped;
    return;
  }
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
    case Status::waiting:  // no job that was begun
      break;
  }
}

// Writing the run's own files may fail without harm to the jobs.
void or_complain(const Run& run, const std::function<void()>& write) {
  try {
    write();
  } catch (const Error& error) {
    run.bar.complaint(error.what());
  }
}

void add_scores(Run& run, const PlannedJob& planned, JobRecord& record, RunLog& log,
                RunSummary& summary) {
  run.bar.start(planned.name + ", scores", 1, 1);
  if (run.stopped() || !score_job(run, planned, record)) {
    summary.unscored = true;
    return;
  }
  if (!record.score_error.empty())
    run.bar.complaint(fmt::format("{}: not scored: {}", planned.name, record.score_error));
  log.set(planned.name, record);
  or_complain(run, [&] { log.keep_up(); });
}

// The exemplar lies beside its results, so that the folder tells the whole story wherever it goes.
void keep_exemplar(Run& run, const Job& job, std::optional<std::size_t>& kept) {
  if (job.exemplar == kept || !job.exemplar) return;
  if (!run.plan.exemplars[*job.exemplar].error.empty()) return;  // its jobs say so
  const Request* request = nullptr;
  try {
    request = &request_of(run, job);
  } catch (const std::exception&) {  // the job, which needs it too, says so
    return;
  }
  kept = job.exemplar;
  or_complain(run, [&] {
    const fs::path folder = run.options.output / exemplar_name(run.config, job);
    create_folder(folder);
    remove_stale_temporaries(folder, "exemplar");
    remove_stale_temporaries(folder, "target");
    write_exemplar(folder, *request, run.files);
  });
}

// Does a job, or finds it finished; run.json follows.
void do_job(Run& run, const PlannedJob& planned, RunLog& log, RunSummary& summary) {
  std::optional<JobRecord> record;
  if (run.options.resume) record = finished_before(run, planned);
  const bool before = record.has_value();
  if (!before) record = run_job(run, planned);
  count_outcome(summary, record->status, before);
  const std::string text = outcome(planned, *record, before);
  record->status == Status::failed ? run.bar.complaint(text) : run.bar.message(text);
  log.set(planned.name, *record);
  or_complain(run, [&] { log.keep_up(); });
  if (lacks_scores(run, planned, *record)) add_scores(run, planned, *record, log, summary);
}

// The jobs of each exemplar and method, as they follow each other in the plan.
std::vector<JobGroup> groups_of(const Plan& plan) {
  std::vector<JobGroup> groups;
  for (const PlannedJob& planned : plan.jobs) {
    const bool same = !groups.empty() &&
                      groups.back().front()->job.exemplar == planned.job.exemplar &&
                      groups.back().front()->job.method == planned.job.method;
    if (!same) groups.emplace_back();
    groups.back().push_back(&planned);
  }
  return groups;
}

// How unlike the finished textures of a group are, unless that is known.
void add_diversity(Run& run, const JobGroup& group, RunLog& log, RunSummary& summary) {
  const Job& first = group.front()->job;
  const bool selected = std::any_of(group.begin(), group.end(),
                                    [](const auto* planned) { return planned->selected; });
  if (!run.config.scores || run.config.direction.fill || !first.exemplar || !selected) return;
  const std::vector<NamedRecord> finished = finished_jobs(run, group);
  SeedDiversity diversity = diversity_of_records(exemplar_name(run.config, first),
                                                 run.config.methods[first.method].name, finished);
  if (finished.size() < 2 || log.knows(diversity)) return;
  const NothingToKeep scope;
  try {
    run.bar.start(job_folder(run.config, first) + " diversity", 1, 1);
    diversity.value = diversity_of(run, first, finished);
    log.set(diversity);
    log.keep_up();
  } catch (const Interrupted&) {
    summary.unscored = true;
  } catch (const std::exception& error) {
    run.bar.complaint(fmt::format("{}: no diversity: {}", job_folder(run.config, first),
                                  first_line(error.what())));
  }
}

}  // namespace

RunSummary run(const Config& config, const RunOptions& options, ProgressBar& bar) {
  const Plan plan = look_ahead(config, options);
  Output output = prepare_output(config, plan, options);
  Run run{config, options, plan, bar};
  run.keep_up = [&] {
    try {
      output.log.keep_up();
    } catch (const Error&) {
      // Said when the job has ended.
    }
  };
  const auto count = static_cast<std::size_t>(
      std::count_if(plan.jobs.begin(), plan.jobs.end(), [](const auto& j) { return j.selected; }));
  warn_of_slow_blas(run);
  RunSummary summary;
  std::size_t number = 0;
  std::optional<std::size_t> kept;  // the exemplar of the last job, once it is copied
  for (const JobGroup& group : groups_of(plan)) {
    for (const PlannedJob* planned : group) {
      if (!planned->selected) continue;
      ++number;
      if (run.stopped()) {
        ++summary.left;
        continue;
      }
      bar.start(planned->name, number, count);
      keep_exemplar(run, planned->job, kept);
      do_job(run, *planned, output.log, summary);
    }
    if (!run.stopped()) add_diversity(run, group, output.log, summary);
  }
  or_complain(run, [&] { output.log.finish(); });
  summary.writes = output.log.writes();
  return summary;
}

}  // namespace gramloom
