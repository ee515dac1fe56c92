#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "jobs/config.h"
#include "jobs/plan.h"

namespace gramloom {

// Tables for `gramloom list` and `gramloom check`.

/// Every method: summary, then each parameter with its default, what is allowed and its meaning.
std::string list_methods();
/// The same of every procedural texture.
std::string list_patterns();
/// These network descriptions by the name that a config uses, with the file's first comment.
std::string list_networks(const std::vector<std::filesystem::path>& files);

/// The selected jobs with their estimated memory and time, and what keeps one from running.
std::string job_table(const Config& config, const Plan& plan);

}  // namespace gramloom
