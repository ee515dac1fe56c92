#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runs/record.h"
#include "runs/run_record.h"
#include "runs/trace_file.h"

namespace gramloom {

/// What a run left of one job. A job that was never begun, or whose record cannot be read, has a
/// record that says so.
struct JobOnDisk {
  std::string name;  // "pebbles/quilting/seed1": its files in the run's folder, without extension
  JobRecord record;
  Trace trace;  // no rows: the method does not iterate
};

/// A run as its folder tells it.
struct RunOnDisk {
  std::filesystem::path folder;
  RunRecord run;
  std::vector<JobOnDisk> jobs;
  std::vector<SeedDiversity> diversity;  // of the textures that are there
};

/// Reads run.json and the jobs that it names. Throws Error when that file is missing or not one of
/// a run; what is wrong with a single job is said in its record.
RunOnDisk read_run(const std::filesystem::path& folder);
/// The same of a folder that a command was told: throws ConfigError, which names the folder.
RunOnDisk read_named_run(const std::filesystem::path& folder);

}  // namespace gramloom
