#pragma once

#include <string>

#include "io/json_text.h"
#include "jobs/config.h"
#include "jobs/plan.h"

namespace gramloom {

/// The config of one of a config's jobs alone, with every setting and absolute paths: its texture
/// is the same.
std::string job_config(const Config& config, const Job& job);

/// The settings of a job without how the paths of files are written: two jobs for which these are
/// equal make the same pixels.
Json settings_by_content(Json settings);

}  // namespace gramloom
