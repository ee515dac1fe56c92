#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "core/error.h"
#include "jobs/output_guard.h"
#include "report/page.h"

namespace gramloom {

namespace {

ExitCode report_run(const std::string& folder) {
  try {
    check_page(folder);
  } catch (const Error& error) {
    throw ConfigError("report {}: {}", folder, error.what());
  }
  return print(write_page(folder).string() + "\n");
}

}  // namespace

Command add_report(CLI::App& program) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* report = program.add_subcommand(
      "report", "Write the page of a run (again) from what is in its folder");
  report->add_option("folder", *folder, "folder of a run")->required()->type_name("DIR");
  return {report, [folder] { return report_run(*folder); }};
}

}  // namespace gramloom
