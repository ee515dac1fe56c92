#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "python/watched_work.h"

namespace gramloom::python {

/// What `run` and `train` are asked, as on the command line.
struct RunWork {
  std::filesystem::path config;
  std::string output;  // "": out/NAME
  std::string only;
  bool resume = false;
  std::vector<std::string> set;      // "key=value"
  int jobs = 1;                      // of `run` alone, as is the next
  std::optional<std::string> shard;  // "3/16", "" for what Slurm says; none: all
  int threads = 0;
};

/// What a run has left, and what it had to complain of: a line each.
struct RunDone {
  std::string records;  // a JSON list of the jobs' records, each with its "name" and "folder"
  std::vector<std::string> complaints;
};

/// Does the jobs of a config, or trains its models and then does the jobs of these. A job that
/// fails is in its record. Throws ConfigError for what the user must change; train() throws Error
/// when no model could be trained.
RunDone run(const RunWork& work, Watch& watch);
RunDone train(const RunWork& work, Watch& watch);

}  // namespace gramloom::python
