#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "jobs/plan.h"
#include "jobs/runner.h"
#include "runs/record.h"
#include "runs/score_sheet.h"

namespace gramloom {

/// A run's own files: run.json (what ran where, how every job stands, the diversity of each
/// method's seeds) and scores.csv (a line a job). Jobs that were never begun are "waiting". Both
/// files are written anew at each change.
class RunFile {
 public:
  /// Reads how the jobs stand in the output folder and writes the files. Throws Error.
  RunFile(const Config& config, const Plan& plan, const RunOptions& options);

  /// Sets how a job stands. Throws Error when a file cannot be written.
  void set(const std::string& job, const JobRecord& record);

  /// Whether the diversity of exactly these seeds is known; its value does not matter.
  bool knows(const SeedDiversity& diversity) const;
  /// Sets a diversity in place of that of the same exemplar and method. Throws Error.
  void set(const SeedDiversity& diversity);
  /// To be called before a texture of this exemplar and method changes. Throws Error.
  void forget_diversity(const std::string& exemplar, const std::string& method);

 private:
  void write() const;

  std::filesystem::path folder_;
  Json head_;
  std::vector<JobState> jobs_;
  std::vector<SeedDiversity> diversity_;
};

/// The diversity table of a run.json; empty when there is none.
std::vector<SeedDiversity> read_diversity(const std::filesystem::path& run_json);

}  // namespace gramloom
