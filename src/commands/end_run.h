#pragma once

#include <filesystem>

#include "commands/command.h"
#include "jobs/progress_bar.h"
#include "jobs/runner.h"

namespace gramloom {

// What commands that do the jobs of a config begin and end with.

/// Freed buffers stay with the process: large ones come and go at each step, and faulting them in
/// again costs up to half of the time.
void keep_large_buffers();

/// Writes the page of a run, says what is left of it, and how the program ends.
ExitCode end_run(const std::filesystem::path& output, const RunSummary& summary, ProgressBar& bar);

}  // namespace gramloom
