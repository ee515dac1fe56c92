#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "runs/record.h"
#include "runs/score_sheet.h"

namespace gramloom {

/// What a run left: its jobs by name, and their folder.
struct Baseline {
  std::filesystem::path folder;
  std::map<std::string, JobRecord> jobs;  // those that were begun
  std::vector<SeedDiversity> diversity;
};

/// Reads what a run left in `folder`, of the jobs that match `only` (job_matches()). Throws Error
/// with the file that is missing or broken: run.json or the record of a job in it.
Baseline read_baseline(const std::filesystem::path& folder, const std::string& only);

/// Throws Error for a picture of a finished job that cannot be read.
void check_pictures(const Baseline& baseline);

}  // namespace gramloom
