#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "runs/diversity.h"
#include "runs/record.h"

namespace gramloom {

/// What a run left: its jobs by name, and their folder.
struct Baseline {
  std::filesystem::path folder;
  std::map<std::string, JobRecord> jobs;  // those that were begun
  std::vector<SeedDiversity> diversity;
};

/// Reads what a run left in `folder`, of the jobs that match `only` (job_matches()). Throws Error
/// with the file, and the key, that is missing or broken: run.json or the record of a job in it.
Baseline read_baseline(const std::filesystem::path& folder, const std::string& only);

/// Throws Error when nothing can be compared with it: no job is finished, or the picture of one
/// cannot be read.
void check_baseline(const Baseline& baseline);

}  // namespace gramloom
