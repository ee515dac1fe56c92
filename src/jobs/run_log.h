#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "jobs/plan.h"
#include "jobs/runner.h"
#include "runs/run_folder.h"

namespace gramloom {

/// How the jobs of a run stand while it goes on, and the two files that say so: run.json and
/// scores.csv (a line a job). Both follow from the records of jobs and diversities; they are
/// written at the start, at the end, and in between so seldom that this takes no time to speak of,
/// however many jobs there are. Where several processes share a folder, each writes them at its end
/// alone, of all records that are there.
class RunLog {
 public:
  /// Reads how the jobs stand in the output folder. `begins`: then writes the files; otherwise
  /// another process has, and this throws Error when it runs another config. Throws Error.
  RunLog(const Config& config, const Plan& plan, const RunOptions& options, bool begins);
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;
  ~RunLog();  // writes what is left to write, if it can

  /// Sets how a job stands.
  void set(const std::string& job, const JobRecord& record);

  /// Whether the diversity of exactly these textures is known; its value does not matter.
  bool knows(const SeedDiversity& diversity) const;
  /// Sets a diversity, which is on disk, in place of that of the same exemplar and method.
  void set(const SeedDiversity& diversity);

  /// Writes the files if they are behind, and were not written just now. Throws Error.
  void keep_up();
  /// Writes the files if they are behind. Throws Error.
  void finish();
  /// How often the files were written.
  int writes() const { return writes_; }

 private:
  void write();
  void read_jobs_of_others();

  std::filesystem::path folder_;
  RunRecord run_;
  std::vector<NamedRecord> jobs_;
  std::map<std::string, std::size_t> index_;  // of a job's name
  std::set<std::string> own_;                 // jobs that were set
  bool shared_;
  bool behind_ = true;
  int writes_ = 0;
  std::chrono::steady_clock::time_point written_;
  std::chrono::steady_clock::duration writing_{};  // how long that took
};

/// Writes run.json and scores.csv of a run again, by its records. Throws Error.
void rewrite_run_files(const RunOnDisk& run);

}  // namespace gramloom
