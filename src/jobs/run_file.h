#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "jobs/config.h"
#include "jobs/record.h"

namespace gramloom {

/// A run's run.json: what ran where, and how every job stands. Jobs that were never begun are
/// "waiting".
class RunFile {
 public:
  /// Reads how the jobs stand in `output` and writes the file. Throws Error.
  RunFile(const Config& config, const Plan& plan, const std::filesystem::path& output);

  /// Sets how a job stands and writes the file. Throws Error.
  void set(const std::string& job, const JobRecord& record);

 private:
  void write() const;

  std::filesystem::path file_;
  Json content_;
};

}  // namespace gramloom
