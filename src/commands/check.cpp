#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "core/error.h"
#include "jobs/config.h"
#include "jobs/input_files.h"
#include "jobs/listing.h"
#include "jobs/output_guard.h"
#include "jobs/plan.h"
#include "jobs/runner.h"
#include "jobs/training.h"

namespace gramloom {

namespace {

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

ExitCode check_config(const ConfigOptions& options) {
  const Config config = read_config(options.config, options.set);
  std::string text;
  if (!config.models.empty()) text = lesson_table(config, options.only);
  const Plan plan = make_plan(config, options.only);
  if (has_selected(plan))
    text += job_table(config, plan);
  else if (text.empty())
    throw ConfigError("--only {}: no model and no job of {} matches", options.only,
                      config.file.string());
  return print(text + output_refusal(config, plan));
}

}  // namespace

Command add_check(CLI::App& program) {
  const auto options = std::make_shared<ConfigOptions>();
  CLI::App* check = program.add_subcommand(
      "check", "Validate a config and list its jobs with estimated memory and time");
  add_config_options(*check, *options);
  return {check, [options] { return check_config(*options); }};
}

}  // namespace gramloom
