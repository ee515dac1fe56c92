#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "jobs/plan.h"
#include "jobs/runner.h"
#include "runs/run_record.h"

namespace gramloom {

/// How the jobs of a run stand while it goes on, and the two files that say so: run.json and
/// scores.csv (a line a job). Both follow from the jobs' records; they are written at the start, at
/// the end, and in between at most once a second, however many jobs end in it.
class RunLog {
 public:
  /// Reads how the jobs stand in the output folder and writes the files. Throws Error.
  RunLog(const Config& config, const Plan& plan, const RunOptions& options);
  RunLog(RunLog&&) = default;
  ~RunLog();  // writes what is left to write, if it can

  /// Sets how a job stands.
  void set(const std::string& job, const JobRecord& record);
  /// The finished jobs of an exemplar and method: what a diversity is to be of.
  SeedDiversity finished(const std::string& exemplar, const std::string& method) const;
  /// Whether the diversity of exactly these textures is known; its value does not matter.
  bool knows(const SeedDiversity& diversity) const;
  /// Sets a diversity in place of that of the same exemplar and method.
  void set(const SeedDiversity& diversity);

  /// Writes the files if they are behind, and older than a second. Throws Error.
  void keep_up();
  /// Writes the files if they are behind. Throws Error.
  void finish();
  /// How often the files were written.
  int writes() const { return writes_; }

 private:
  void write();

  std::filesystem::path folder_;
  RunRecord run_;
  std::vector<NamedRecord> jobs_;
  std::map<std::string, std::size_t> index_;  // of a job's name
  bool behind_ = true;
  int writes_ = 0;
  std::chrono::steady_clock::time_point written_;
};

}  // namespace gramloom
