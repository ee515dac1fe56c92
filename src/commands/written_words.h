#pragma once

#include <filesystem>
#include <vector>

#include "commands/completions.h"

namespace gramloom {

// Words that may complete a command line because a config or a run has them. None where there is no
// such file, or none that can be read.

/// "method.NAME.key=" of each method and each of its keys.
std::vector<Candidate> settings_of_methods(const std::filesystem::path& config);

/// "exemplar/method/seed1": the jobs of a config, and the finished ones of a run.
std::vector<Candidate> jobs_of_config(const std::filesystem::path& config);
std::vector<Candidate> jobs_of_run(const std::filesystem::path& folder);

}  // namespace gramloom
