#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/with_progress.h"
#include "jobs/progress_bar.h"
#include "jobs/simulation.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct SimulateArguments {
  std::string config;
  std::string output;
  int threads = 0;
  bool quiet = false;
};

ExitCode simulate_config(const SimulateArguments& arguments) {
  use_threads(arguments.threads);
  const Simulation simulation = read_simulation(arguments.config);
  return with_progress("simulate", arguments.quiet, [&](const Control& control, ProgressBar&) {
    return make_simulation(simulation, arguments.output, control).string() + "\n";
  });
}

}  // namespace

Command add_simulate(CLI::App& program) {
  const auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* simulate = program.add_subcommand(
      "simulate",
      "Simulate a sleeve of cloth in many poses of its arm: pictures of its folds and a table of "
      "poses, for a network to learn");
  simulate->add_option("config", arguments->config, "config file (TOML), as data/sleeve.toml")
      ->required();
  simulate->add_option("--output", arguments->output, "folder of the pictures and the table")
      ->required()
      ->type_name("DIR");
  add_threads(*simulate, arguments->threads);
  simulate->add_flag("--quiet", arguments->quiet, "show no progress");
  return {simulate, [arguments] { return simulate_config(*arguments); }};
}

}  // namespace gramloom
