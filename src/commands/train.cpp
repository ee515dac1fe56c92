#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/end_run.h"
#include "core/error.h"
#include "core/spinning.h"
#include "jobs/config.h"
#include "jobs/interruption.h"
#include "jobs/job_preview.h"
#include "jobs/output_guard.h"
#include "jobs/progress_bar.h"
#include "jobs/runner.h"
#include "jobs/training.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct TrainArguments {
  ConfigOptions config;
  std::string output;
  int threads = 0;
  bool resume = false;
  bool quiet = false;
  std::vector<std::string> words;  // the command line itself
};

// The page of a training without textures, which shows the sequences that it made: a run of no job,
// or what an earlier training left.
ExitCode show_models(const Config& config, const RunOptions& options, ProgressBar& bar) {
  if (std::filesystem::exists(options.output / "run.json")) return end_run(options, {}, bar);
  Config models = config;
  models.models.clear();
  return end_run(options, run(models, options, bar), bar);
}

ExitCode train(const TrainArguments& arguments) {
  keep_large_buffers();
  use_threads(arguments.threads);
  const Config config = read_config(arguments.config.config, arguments.config.set);
  if (config.models.empty())
    throw ConfigError("{}: there is no [[model]] to train", config.file.string());
  check_previews(config);
  if (std::filesystem::is_regular_file(config.file)) bound_spinning(arguments.words);
  RunOptions options = begin_run(config, arguments.output, arguments.resume, arguments.words);
  options.only = arguments.config.only;
  ProgressBar bar(progress_style(arguments.quiet));
  const Trained trained = train_models(config, options, bar);
  if (trained.interrupted) {
    bar.complaint("gramloom: interrupted; --resume goes on");
    return interrupted;
  }
  const auto textures = textures_of_trained(config, trained, options.only);
  if (!textures && trained.failed > 0) return job_failed;
  const ExitCode ended = textures ? end_run(options, run(*textures, options, bar), bar)
                                  : show_models(config, options, bar);
  return ended == all_done && trained.failed > 0 ? job_failed : ended;
}

}  // namespace

Command add_train(CLI::App& program, const std::vector<std::string>& words) {
  const auto arguments = std::make_shared<TrainArguments>();
  arguments->words = words;
  CLI::App* command = program.add_subcommand(
      "train",
      "Train the models of a config, each once; then make and score textures by them, and by the "
      "config's methods, as a run");
  add_config_options(*command, arguments->config);
  command->add_option("--output", arguments->output, "folder of the results (out/<config's name>)")
      ->type_name("DIR");
  add_threads(*command, arguments->threads);
  command->add_flag("--resume", arguments->resume,
                    "keep finished models and textures, and go on with unfinished ones");
  command->add_flag("--quiet", arguments->quiet, "show no progress");
  return {command, [arguments] { return train(*arguments); }};
}

}  // namespace gramloom
