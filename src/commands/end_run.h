#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "commands/command.h"
#include "jobs/progress_bar.h"
#include "jobs/runner.h"

namespace gramloom {

// What commands that do the jobs of a config begin and end with.

/// Freed buffers stay with the process: large ones come and go at each step, and faulting them in
/// again costs up to half of the time.
void keep_large_buffers();

/// Watches for Ctrl-C, and where the results of `config` go: to `output`, or its own folder if that
/// is empty. `words`: the command line.
RunOptions begin_run(const Config& config, const std::string& output, bool resume,
                     const std::vector<std::string>& words);

/// Writes the page of a run, says what is left of it, and how the program ends.
ExitCode end_run(const RunOptions& options, const RunSummary& summary, ProgressBar& bar);

}  // namespace gramloom
