// Arguments -> command -> exit code: the only place that catches everything and prints.
#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <thread>

#include "core/error.h"
#include "core/spinning.h"
#include "core/threads.h"
#include "io/field_values.h"
#include "io/text_file.h"
#include "jobs/baseline_compare.h"
#include "jobs/config.h"
#include "jobs/input_files.h"
#include "jobs/interruption.h"
#include "jobs/listing.h"
#include "jobs/machine.h"
#include "jobs/output_guard.h"
#include "jobs/plan.h"
#include "jobs/progress_bar.h"
#include "jobs/runner.h"
#include "jobs/score_files.h"
#include "report/page.h"
#include "runs/format.h"

namespace {

using namespace gramloom;

enum ExitCode { all_done = 0, job_failed = 1, bad_usage = 2, interrupted = 130 };

struct Arguments {
  std::string config;
  std::string output;
  std::string only;
  std::vector<std::string> set;
  std::string topic;
  std::string exemplar;
  std::vector<std::string> images;
  std::string tile = "none";
  bool json = false;
  bool controls = false;
  int threads = 0;
  bool resume = false;
  bool quiet = false;
  std::string baseline;
  std::string folder;
  std::vector<std::string> words;  // the command line itself
};

// A parent may have closed our standard streams; a result's file must not get their numbers.
void keep_standard_streams_open() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDWR) == -1) std::_Exit(bad_usage);
}

// Freed buffers stay with the process: large ones come and go at each step, and faulting them in
// again costs up to half of the time.
void keep_large_buffers() {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 2147483647);
}

// Writes to standard output. A reader who has gone away is no mistake of ours.
ExitCode print(const std::string& text) {
  const bool complete =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (complete || errno == EPIPE) return all_done;
  throw Error("cannot write to standard output: {}", std::strerror(errno));
}

// What --baseline names, read and checked before any work.
std::optional<Baseline> earlier_run(const Arguments& arguments, const RunOptions& options) {
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

// Prints what differs from an earlier run and leaves it as baseline.json; whether any of it is for
// the worse.
bool got_worse(const Baseline& before, const Config& config, const RunOptions& options,
               bool quiet) {
  const NothingToKeep scope;
  const Baseline now = read_baseline(options.output, options.only);
  const auto changes = compare(before, now, config.baseline);
  write_format(options.output / "baseline.json",
               comparison_record(changes, before, config.baseline));
  if (!quiet || !changes.empty()) print(change_table(changes, before, now));
  return count_worse(changes) > 0;
}

// Writes the page of a run; the results are there whatever becomes of it.
bool show_run(const std::filesystem::path& folder, ProgressBar& bar) {
  const NothingToKeep scope;
  try {
    bar.message(fmt::format("page: {}", write_page(folder).string()));
    return true;
  } catch (const std::exception& error) {
    bar.complaint(fmt::format("gramloom: no page: {}", first_line(error.what())));
    return false;
  }
}

// Whether the libraries of neural methods, which bring OpenMP's threads, will be at work.
bool has_neural_jobs(const Config& config) {
  return std::ranges::any_of(config.methods, [](const MethodEntry& method) {
    return std::holds_alternative<NeuralParams>(method.method);
  });
}

ExitCode run_command(const Arguments& arguments) {
  keep_large_buffers();
  set_thread_count(arguments.threads);
  const Config config = read_config(arguments.config, arguments.set);
  if (has_neural_jobs(config) && std::filesystem::is_regular_file(config.file))
    bound_spinning(arguments.words);
  watch_signals();
  RunOptions options;
  options.is_default_output = arguments.output.empty();
  options.output =
      options.is_default_output ? default_output(config) : std::filesystem::path(arguments.output);
  options.only = arguments.only;
  options.resume = arguments.resume;
  options.stop = stop_asked;
  options.command = arguments.words;
  const std::optional<Baseline> before = earlier_run(arguments, options);
  if (before) options.inputs = input_files(*before);
  ProgressBar bar(progress_style(arguments.quiet));
  const RunSummary summary = run(config, options, bar);
  const bool shown = show_run(options.output, bar);
  if (summary.interrupted + summary.left > 0) {
    bar.complaint(fmt::format(
        "gramloom: interrupted, {} of {} jobs are left; --resume goes on",
        summary.interrupted + summary.left,
        summary.done + summary.skipped + summary.failed + summary.interrupted + summary.left));
    return interrupted;
  }
  if (summary.unscored) {
    bar.complaint("gramloom: interrupted, not all textures are scored; --resume goes on");
    return interrupted;
  }
  const bool worse = before && got_worse(*before, config, options, arguments.quiet);
  return worse || !shown || summary.failed > 0 ? job_failed : all_done;
}

ExitCode report_command(const Arguments& arguments) {
  try {
    check_page(arguments.folder);
  } catch (const Error& error) {
    throw ConfigError("report {}: {}", arguments.folder, error.what());
  }
  return print(write_page(arguments.folder).string() + "\n");
}

// What would keep a run from writing its results where it does when it is told nothing else.
std::string output_refusal(const Config& config, const Plan& plan) {
  const std::filesystem::path output = default_output(config);
  try {
    check_default_output(config, output);
    check_output(config, plan, output, input_files(config));
    return "";
  } catch (const Error& error) {
    return fmt::format("cannot run: --output {}: {}\n", output.string(), error.what());
  }
}

ExitCode check_command(const Arguments& arguments) {
  const Config config = read_config(arguments.config, arguments.set);
  const Plan plan = make_plan(config, arguments.only);
  return print(job_table(config, plan) + output_refusal(config, plan));
}

ExitCode list_command(const Arguments& arguments) {
  const auto wanted = [&](std::string_view topic) {
    return arguments.topic.empty() || arguments.topic == topic;
  };
  std::string text;
  if (wanted("methods")) text += list_methods();
  if (wanted("networks")) text += list_networks();
  if (wanted("patterns")) text += list_patterns();
  if (wanted("metrics")) text += list_metrics();
  return print(text);
}

ExitCode score_command(const Arguments& arguments) {
  set_thread_count(arguments.threads);
  constexpr auto names = enum_names<Tile>;
  static_assert(NamedEnum<Tile>);
  const Tile tile =
      static_cast<Tile>(std::find(names.begin(), names.end(), arguments.tile) - names.begin());
  const auto scored =
      score_files(arguments.exemplar, arguments.images, tile, arguments.controls, {});
  ExitCode code = all_done;
  for (const ScoredImage& image : scored) {
    if (image.error.empty()) continue;
    print_message(fmt::format("gramloom: {}", image.error));
    code = job_failed;
  }
  print(arguments.json ? score_json(scored) : score_table(scored));
  return code;
}

void add_config_options(CLI::App& command, Arguments& arguments) {
  command.add_option("config", arguments.config, "config file (TOML)")->required();
  command
      .add_option(
          "--only", arguments.only,
          "only jobs whose exemplar/method or exemplar/method/seedN matches: * stands for any "
          "letters, ? for one, all else for itself")
      ->type_name("GLOB");
  command
      .add_option("--set", arguments.set,
                  "in place of what the config says: a top-level key, a parameter of every "
                  "method that has it, method.NAME.key or exemplar.NAME.key")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

// Many more threads than cores bring the work to a halt; some more must be allowed, as results of
// neural methods depend on the number.
void add_threads(CLI::App& command, Arguments& arguments) {
  const int most = 8 * static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  command.add_option("--threads", arguments.threads, "threads; 0: every core")
      ->type_name("N")
      ->check(CLI::Range(0, most));
}

void add_run(CLI::App& app, Arguments& arguments) {
  CLI::App* run = app.add_subcommand(
      "run",
      "Do the jobs of a config. Results of an earlier run into the same folder are replaced "
      "as each job completes; with --resume, finished ones are kept.");
  add_config_options(*run, arguments);
  run->add_option("--output", arguments.output, "folder of the results (out/<config's name>)")
      ->type_name("DIR");
  add_threads(*run, arguments);
  run->add_flag("--resume", arguments.resume, "keep finished jobs and go on with unfinished ones");
  run->add_option("--baseline", arguments.baseline,
                  "folder of an earlier run: print what differs, by the limits of the config's "
                  "[baseline]; exit code 1 when something got worse")
      ->type_name("DIR");
  run->add_flag("--quiet", arguments.quiet, "show no progress");
}

void add_score(CLI::App& app, Arguments& arguments) {
  CLI::App* score = app.add_subcommand(
      "score", "Score pictures, of gramloom or not, against the exemplar they were made from");
  score->add_option("exemplar", arguments.exemplar, "the exemplar's file")->required();
  score->add_option("images", arguments.images, "pictures to score")->required();
  score->add_flag("--json", arguments.json, "JSON in place of a table");
  score->add_flag("--controls", arguments.controls,
                  "score pictures with known faults beside them: shuffled pixels, random phase, "
                  "the exemplar tiled, its halves");
  score->add_option("--tile", arguments.tile, "axes on which the pictures tile, for the seams")
      ->check(CLI::IsMember({"none", "x", "y", "both"}));
  add_threads(*score, arguments);
}

ExitCode dispatch(int argc, char** argv) {
  Arguments arguments;
  arguments.words.assign(argv, argv + argc);
  CLI::App app("New textures from a small picture of one.", "gramloom");
  app.set_version_flag("--version", fmt::format("gramloom {}", version()));
  app.require_subcommand(1);
  app.footer(
      "Exit code: 0 all done; 1 a job failed or got worse; 2 bad usage or config; 130 "
      "interrupted.");
  add_run(app, arguments);
  add_config_options(
      *app.add_subcommand("check",
                          "Validate a config and list its jobs with estimated memory and time"),
      arguments);
  app.add_subcommand("list", "List methods, networks, patterns and metrics")
      ->add_option("topic", arguments.topic, "one of methods, networks, patterns, metrics")
      ->check(CLI::IsMember({"methods", "networks", "patterns", "metrics"}));
  add_score(app, arguments);
  app.add_subcommand("report", "Write the page of a run (again) from what is in its folder")
      ->add_option("folder", arguments.folder, "folder of a run")
      ->required()
      ->type_name("DIR");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion&) {
    return print(fmt::format("gramloom {}\n", version()));
  } catch (const CLI::Success&) {
    // --help, of the program or of a command.
    const auto commands = app.get_subcommands();
    return print(commands.empty() ? app.help() : commands.front()->help(app.get_name()));
  } catch (const CLI::ParseError& error) {
    throw ConfigError("{} (see --help)", error.what());
  }
  const std::string command = app.get_subcommands().front()->get_name();
  if (command == "run") return run_command(arguments);
  if (command == "report") return report_command(arguments);
  if (command == "check") return check_command(arguments);
  if (command == "score") return score_command(arguments);
  return list_command(arguments);
}

}  // namespace

int main(int argc, char** argv) {
  keep_standard_streams_open();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond a limit is an error of its job
  try {
    return dispatch(argc, argv);
  } catch (const ConfigError& error) {
    print_message(error.what());
    return bad_usage;
  } catch (const std::bad_alloc&) {
    print_message("gramloom: out of memory");
  } catch (const std::exception& error) {
    print_message(fmt::format("gramloom: {}", first_line(error.what())));
  }
  return job_failed;
}
