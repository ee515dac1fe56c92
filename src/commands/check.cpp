#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "core/error.h"
#include "io/json_fields.h"
#include "jobs/config.h"
#include "jobs/input_files.h"
#include "jobs/job_preview.h"
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
    return fmt::format("cannot run: --output {}: {}", output.string(), error.what());
  }
}

ExitCode check_config(const ConfigOptions& options, bool as_json) {
  const Config config = read_config(options.config, options.set);
  const std::vector<Expectation> lessons = expected_lessons(config, options.only);
  check_previews(config);
  const Plan plan = make_plan(config, options.only);
  if (!has_selected(plan) && lessons.empty())
    throw ConfigError("--only {}: no model and no job of {} matches", options.only,
                      config.file.string());
  const std::string refusal = output_refusal(config, plan);
  if (!as_json)
    return print(lesson_table(lessons) + (has_selected(plan) ? job_table(config, plan) : "") +
                 (refusal.empty() ? "" : refusal + "\n"));
  Json json = jobs_json(config, plan);
  json["models"] = to_json_value(lessons);
  json["problem"] = refusal;
  return print(to_text(json, 2) + "\n");
}

}  // namespace

Command add_check(CLI::App& program) {
  const auto options = std::make_shared<ConfigOptions>();
  CLI::App* check = program.add_subcommand(
      "check", "Validate a config and list its jobs with estimated memory and time");
  const auto as_json = std::make_shared<bool>(false);
  add_config_options(*check, *options);
  check->add_flag("--json", *as_json, "for programs: bytes and seconds");
  return {check, [options, as_json] { return check_config(*options, *as_json); }};
}

}  // namespace gramloom
