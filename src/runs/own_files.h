#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace gramloom {

// Which files in a folder a run of gramloom made: what bears our mark, whoever runs again. A file
// that cannot be read, or is none (a folder, a pipe), is not ours.

/// index.html, by its generator.
bool is_page(const std::filesystem::path& file);
/// scores.csv, by its first columns.
bool is_score_sheet(const std::filesystem::path& file);
/// baseline.json, by its keys.
bool is_comparison(const std::filesystem::path& file);

/// diversity.json, by its keys.
bool is_diversity(const std::filesystem::path& file);

/// What a run.json says of the run that wrote it.
struct EarlierRun {
  bool is_ours = false;           // false: there is none, or it is not ours
  std::string config;             // its config file, as the command line named it
  std::set<std::string> begun;    // names of the jobs that were begun: "pebbles/quilting/seed1"
  std::set<std::string> folders;  // of the exemplars of all its jobs: "pebbles"
};
EarlierRun earlier_run_in(const std::filesystem::path& folder);

}  // namespace gramloom
