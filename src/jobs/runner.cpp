#include "jobs/runner.h"

#include <algorithm>
#include <memory>

#include "core/threads.h"
#include "jobs/folder_lock.h"
#include "jobs/interruption.h"
#include "jobs/job_preview.h"
#include "jobs/one_job.h"
#include "jobs/output_guard.h"
#include "jobs/run_state.h"
#include "jobs/side_by_side.h"
#include "neural/blas_speed.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

Plan look_ahead(const Config& config, const RunOptions& options) {
  const NothingToKeep scope;
  check_previews(config);
  Plan plan = make_plan(config, options.only);
  if (options.shard) select_shard(plan, *options.shard);
  if (options.group) estimate_together(config, plan, options.group->size());
  return plan;
}

// A folder that can be written and is ours, alone or with the other shards, with run.json in it,
// or a ConfigError.
struct Output {
  std::optional<FileLock> lock;
  std::unique_ptr<RunLog> log;
};
Output prepare_output(const Config& config, const Plan& plan, const RunOptions& options) {
  const fs::path& output = options.output;
  try {
    create_folder(output);
    std::optional<FileLock> lock;
    bool alone = true;
    if (options.shard) {
      SharedFolder shared = share_folder(output);
      alone = shared.alone;
      lock.emplace(std::move(shared.lock));
    } else {
      lock = lock_folder(output);
    }
    if (options.is_default_output) check_default_output(config, output);
    std::vector<InputFile> inputs = input_files(config);
    inputs.insert(inputs.end(), options.inputs.begin(), options.inputs.end());
    check_output(config, plan, output, inputs);
    if (alone) {
      for (const auto* stem : {"run", "scores", "index", "baseline"})
        remove_stale_temporaries(output, stem);
      remove_stale_views(output);
    }
    auto log = std::make_unique<RunLog>(config, plan, options, alone);
    if (options.shard && alone && !lock->share()) throw Error("another run is writing there");
    return {std::move(lock), std::move(log)};
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

// Does a job, or finds it finished; run.json follows. False: another process has it at this time.
bool do_job(RunState& state, const PlannedJob& planned, bool waits) {
  Run& run = state.run;
  const int number = number_of(run.plan, planned);
  std::optional<JobRecord> record = finished_before(state, planned);
  if (record) {
    settle_finished_before(state, planned, *record);
  } else {
    const TaskResult result = do_task(run, {TaskKind::texture, number, waits});
    settle_texture(state, planned, result);
    if (!result.elsewhere.empty()) return false;
    record = result.record;
  }
  if (!record || !lacks_scores(run, planned, *record)) return true;
  run.bar.start(planned.name + ", scores", 1, 1);
  settle_scores(state, planned,
                run.stopped() ? TaskResult{{}, {}, true, "", ""}
                              : do_task(run, {TaskKind::scores, number, waits}));
  return true;
}

void compare_seeds(RunState& state, const JobGroup& group) {
  Run& run = state.run;
  if (run.stopped() || !wants_diversity(state, group)) return;
  const int first = number_of(run.plan, *group.front());
  run.bar.start(job_folder(run.config, group.front()->job) + " diversity", 1, 1);
  settle_diversity(state, group, do_task(run, {TaskKind::diversity, first}));
}

void do_one_after_another(RunState& state, std::size_t count) {
  Run& run = state.run;
  std::size_t number = 0;           // of the jobs begun
  std::optional<std::size_t> kept;  // the exemplar of the last job, once it is copied
  JobGroup elsewhere;
  for (const JobGroup& group : groups_of(run.plan)) {
    for (const PlannedJob* planned : group) {
      if (!planned->selected) continue;
      ++number;
      if (run.stopped() || run.lost) {
        ++state.summary.left;
        continue;
      }
      run.bar.start(planned->name, number, count);
      keep_exemplar(state, planned->job, kept);
      if (!do_job(state, *planned, false)) elsewhere.push_back(planned);
    }
    compare_seeds(state, group);
  }
  // Whoever has them may die: a job is left to nobody.
  for (const PlannedJob* planned : elsewhere) {
    run.bar.start(planned->name, number, count);
    do_job(state, *planned, true);
    compare_seeds(state, group_of(run.plan, number_of(run.plan, *planned)));
  }
}

}  // namespace

RunOptions run_options(const Config& config, const fs::path& output, bool resume,
                       const std::vector<std::string>& command) {
  RunOptions options;
  options.is_default_output = output.empty();
  options.output = output.empty() ? default_output(config) : output;
  options.resume = resume;
  options.command = command;
  return options;
}

void spread(RunOptions& options, const Config& config, const std::optional<std::string>& shard,
            int jobs) {
  if (shard) try {
      options.shard = shard->empty() ? shard_of_slurm() : parse_shard(*shard);
    } catch (const Error& error) {
      throw ConfigError("--shard: {}", error.what());
    }
  if (jobs < 0 || jobs > most_jobs)
    throw ConfigError("--jobs {}: allowed are 0 to {}", jobs, most_jobs);
  options.jobs = jobs > 0 ? jobs : thread_count();
  if (options.jobs > 1 && !fs::is_regular_file(config.file))
    throw ConfigError("--jobs {}: {} is no file that each of its processes can read", options.jobs,
                      config.file.string());
}

RunSummary run(const Config& config, const RunOptions& options, ProgressBar& bar) {
  const Plan plan = look_ahead(config, options);
  Output output = prepare_output(config, plan, options);
  Run run{config, options, plan, bar};
  run.keep_up = [&] {
    try {
      output.log->keep_up();
    } catch (const Error&) {
      // Said when the job has ended.
    }
  };
  const auto count = static_cast<std::size_t>(
      std::count_if(plan.jobs.begin(), plan.jobs.end(), [](const auto& j) { return j.selected; }));
  warn_of_slow_blas(run);
  RunSummary summary;
  RunState state{run, *output.log, summary};
  if (options.jobs > 1)
    do_side_by_side(state);
  else
    do_one_after_another(state, count);
  tell_unkept(state);
  if (!or_complain(run, [&] { output.log->finish(); })) summary.lacking = true;
  if (options.group && !run.lost && !run.halted)
    or_complain(run, [&] { say_next(*options.group, std::nullopt); });
  summary.writes = output.log->writes();
  return summary;
}

}  // namespace gramloom
