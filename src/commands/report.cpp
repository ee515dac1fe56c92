#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "core/error.h"
#include "jobs/folder_lock.h"
#include "jobs/output_guard.h"
#include "jobs/progress_bar.h"
#include "jobs/run_log.h"
#include "report/page.h"
#include "runs/own_files.h"

namespace gramloom {

namespace {

// Shards have left records, and what follows from them is to be of all. Not while some still work:
// they do so at their end.
RunOnDisk gather_records(const std::string& folder) {
  std::optional<FileLock> lock;
  try {
    lock = lock_folder(folder);
  } catch (const Error&) {
  }
  RunOnDisk run = read_named_run(folder);
  const auto scores = run.folder / "scores.csv";
  if (lock && (!std::filesystem::exists(scores) || is_score_sheet(scores))) rewrite_run_files(run);
  return run;
}

ExitCode report_run(const std::string& folder) {
  try {
    check_page(folder);
  } catch (const Error& error) {
    throw ConfigError("report {}: {}", folder, error.what());
  }
  const WrittenPage page = write_page(gather_records(folder));
  for (const std::string& trouble : page.trouble)
    print_message(fmt::format("gramloom: not on the page: {}", trouble));
  const ExitCode printed = print(page.file.string() + "\n");
  return page.trouble.empty() ? printed : job_failed;
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
