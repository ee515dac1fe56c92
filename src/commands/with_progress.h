#pragma once

#include <functional>
#include <string>

#include "commands/command.h"
#include "core/progress.h"
#include "jobs/progress_bar.h"

namespace gramloom {

/// Does work that leaves nothing to keep when the user stops it: shows its progress under that name
/// and listens to signals. `work` returns what is printed.
ExitCode with_progress(const std::string& name, bool quiet,
                       const std::function<std::string(const Control&, ProgressBar&)>& work);

}  // namespace gramloom
