#pragma once

#include <filesystem>
#include <vector>

#include "jobs/input_files.h"
#include "jobs/plan.h"

namespace gramloom {

/// Throws Error when a run of the plan's selected jobs into `output` would write over, delete or
/// rename a file of `inputs`, under this or another name (links), or would replace a file that no
/// run of gramloom made: "would write over …", "would replace …".
void check_output(const Config& config, const Plan& plan, const std::filesystem::path& output,
                  const std::vector<InputFile>& inputs);

/// The folder of a config's results when the user names none.
std::filesystem::path default_output(const Config& config);

/// Throws Error when `output`, the folder that a config has by default, holds the results of
/// another config of the same name.
void check_default_output(const Config& config, const std::filesystem::path& output);

/// Throws Error when the page of a run in `folder` would replace a file that is none.
void check_page(const std::filesystem::path& folder);

}  // namespace gramloom
