#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/end_run.h"
#include "core/error.h"
#include "core/spinning.h"
#include "io/text_file.h"
#include "jobs/baseline_compare.h"
#include "jobs/config.h"
#include "jobs/input_files.h"
#include "jobs/interruption.h"
#include "jobs/model_entries.h"
#include "jobs/one_job.h"
#include "jobs/output_guard.h"
#include "jobs/progress_bar.h"
#include "jobs/runner.h"
#include "jobs/worker.h"
#include "runs/format.h"
#include "runs/job_files.h"
#include "runs/own_files.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct RunArguments {
  ConfigOptions config;
  SpreadOptions spread;
  CLI::Option* shard = nullptr;  // --shard, with or without a value
  OneJobOptions together;
  CLI::Option* one_job = nullptr;  // --one-job, with or without a value
  int worker = 0;                  // the threads of a worker; 0: this is none
  std::string output;
  int threads = 0;
  bool resume = false;
  std::string baseline;
  bool quiet = false;
  std::vector<std::string> words;  // the command line itself
};

// What --baseline names, read and checked before any work.
std::optional<Baseline> earlier_run(const RunArguments& arguments, const RunOptions& options) {
  if (arguments.baseline.empty()) return std::nullopt;
  const NothingToKeep scope;
  try {
    std::error_code ignored;
    if (std::filesystem::equivalent(arguments.baseline, options.output, ignored))
      throw Error("this run would write over it; choose another --output");
    Baseline baseline = read_baseline(arguments.baseline, options.only);
    check_baseline(baseline);
    return baseline;
  } catch (const Error& error) {
    throw ConfigError("--baseline {}: {}", arguments.baseline, error.what());
  }
}

// One with other results, or with another run, no longer holds.
void forget_comparison(const std::filesystem::path& output) {
  if (is_comparison(output / "baseline.json")) remove_file(output / "baseline.json");
}

// Prints what differs from an earlier run and leaves it as baseline.json; whether any of it is for
// the worse.
bool got_worse(const Baseline& before, const Config& config, const RunOptions& options,
               bool quiet) {
  const NothingToKeep scope;
  const Baseline now = read_baseline(options.output, options.only);
  const auto changes = compare(before, now, config.baseline);
  write_format(options.output / "baseline.json",
               comparison_record(changes, before, now, config.baseline));
  if (!quiet || !changes.empty()) print(change_table(changes, before, now));
  return count_worse(changes) > 0;
}

// Whether the libraries of neural methods, which bring OpenMP's threads, will be at work.
bool has_neural_jobs(const Config& config) {
  return std::ranges::any_of(config.methods, [](const MethodEntry& method) {
    return std::holds_alternative<NeuralParams>(method.method);
  });
}

// How the jobs are spread over processes. Throws ConfigError.
void spread_jobs(const RunArguments& arguments, const Config& config, RunOptions& options) {
  std::optional<std::string> shard;
  if (arguments.shard->count() > 0) shard = arguments.spread.shard;
  spread(options, config, shard, arguments.spread.jobs);
  if (options.shard && !arguments.baseline.empty())
    throw ConfigError("--baseline compares a whole run: not with --shard");
}

// Joins the processes that make each texture together with this one, if there are any. Throws
// ConfigError for what they could not do.
void join_others(const RunArguments& arguments, const Config& config, RunOptions& options) {
  if (arguments.one_job->count() == 0) {
    if (!arguments.together.meeting.empty()) throw ConfigError("--meet goes with --one-job");
    return;
  }
  if (options.shard || options.jobs > 1)
    throw ConfigError("--one-job: not with --shard or --jobs, which do several jobs at once");
  const neural::GroupPlace place = group_place(arguments.together, options.output);
  if (place.size == 1) return;
  check_together(config, options.only, place.size);
  create_folder(options.output);  // where they may meet
  const NothingToKeep scope;
  options.group = gramloom::join_group(place);  // opens the neural module
}

ExitCode run_config(const RunArguments& arguments) {
  keep_large_buffers();
  use_threads(arguments.worker > 0 ? arguments.worker : arguments.threads);
  const Config config = read_config(arguments.config.config, arguments.config.set);
  refuse_models(config, "run");
  if (has_neural_jobs(config) && std::filesystem::is_regular_file(config.file))
    bound_spinning(arguments.words);
  RunOptions options = begin_run(config, arguments.output, arguments.resume, arguments.words);
  options.only = arguments.config.only;
  spread_jobs(arguments, config, options);
  if (arguments.worker > 0) {
    work_for_parent(config, options);
    return all_done;
  }
  join_others(arguments, config, options);
  if (options.group && options.group->rank() > 0) {
    return work_for_first(config, options) ? all_done : interrupted;
  }
  const std::optional<Baseline> before = earlier_run(arguments, options);
  if (before) options.inputs = input_files(*before);
  ProgressBar bar(progress_style(arguments.quiet));
  const RunSummary summary = run(config, options, bar);
  forget_comparison(options.output);
  const bool whole = summary.interrupted + summary.left == 0 && !summary.unscored;
  const bool worse = before && whole && got_worse(*before, config, options, arguments.quiet);
  const ExitCode ended = end_run(options, summary, bar);  // the page shows the comparison
  return worse && ended != interrupted ? job_failed : ended;
}

}  // namespace

Command add_run(CLI::App& program, const std::vector<std::string>& words) {
  const auto arguments = std::make_shared<RunArguments>();
  arguments->words = words;
  CLI::App* run = program.add_subcommand(
      "run",
      "Do the jobs of a config. Results of an earlier run into the same folder are replaced "
      "as each job completes; with --resume, finished ones are kept.");
  add_config_options(*run, arguments->config);
  arguments->shard = add_spread_options(*run, arguments->spread);
  arguments->one_job =
      run->add_option("--one-job", arguments->together.process,
                      "this is the K-th of N processes that make each texture together, each some "
                      "of its rows; alone, in a step of Slurm (srun): as that says")
          ->type_name("[K/N]")
          ->expected(0, 1);
  run->add_option("--meet", arguments->together.meeting,
                  "with --one-job: where they meet, HOST:PORT of the first process (by hand "
                  "127.0.0.1:29571), or a file in a folder that all of them see and that is not "
                  "there yet (in Slurm, in the folder of the results)")
      ->type_name("PLACE");
  run->add_option("--patience", arguments->together.patience,
                  "with --one-job: seconds until one that does not answer is given up (1800)")
      ->type_name("SECONDS")
      ->check(CLI::Range(1, 1000000));
  run->add_option("--worker", arguments->worker)->group("");  // what --jobs starts
  run->add_option("--output", arguments->output, "folder of the results (out/<config's name>)")
      ->type_name("DIR");
  add_threads(*run, arguments->threads);
  run->add_flag("--resume", arguments->resume, "keep finished jobs and go on with unfinished ones");
  run->add_option("--baseline", arguments->baseline,
                  "folder of an earlier run: print what differs, by the limits of the config's "
                  "[baseline]; exit code 1 when something got worse")
      ->type_name("DIR");
  run->add_flag("--quiet", arguments->quiet, "show no progress");
  return {run, [arguments] { return run_config(*arguments); }};
}

}  // namespace gramloom
