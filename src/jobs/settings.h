#pragma once

#include <filesystem>
#include <string>

#include "jobs/plan.h"
#include "runs/json.h"

namespace gramloom {

/// A method's kind and every parameter, defaults included; paths relative to `folder`.
Json method_to_json(const Method& method, const std::filesystem::path& folder);

/// Everything that a job's result depends on, and nothing else: two jobs with equal settings have
/// equal results. Files count by their content.
Json job_settings(const Config& config, const Plan& plan, const Job& job);

/// The whole config with every default, for run.json.
Json config_to_json(const Config& config);

/// The hash of a file's bytes (core/hash.h). Throws Error when the file cannot be read.
std::string file_hash(const std::filesystem::path& path);

}  // namespace gramloom
