#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace gramloom {

enum ExitCode { all_done = 0, job_failed = 1, bad_usage = 2, interrupted = 130 };

/// A command of the program: its part of the command line, and what does its work once that is
/// read. The work throws ConfigError for what the user must change, other exceptions when it fails.
struct Command {
  CLI::App* app = nullptr;
  std::function<ExitCode()> work;
};

/// Each adds a command to the program's command line. `words` is the command line itself.
Command add_make(CLI::App& program, const std::vector<std::string>& words);
Command add_run(CLI::App& program, const std::vector<std::string>& words);
Command add_new(CLI::App& program);
Command add_train(CLI::App& program, const std::vector<std::string>& words);
Command add_generate(CLI::App& program);
Command add_check(CLI::App& program);
Command add_list(CLI::App& program);
Command add_score(CLI::App& program);
Command add_report(CLI::App& program);
Command add_pick(CLI::App& program);
Command add_maps(CLI::App& program);
Command add_preview(CLI::App& program);
Command add_tile(CLI::App& program);
Command add_fill(CLI::App& program);
Command add_arrange(CLI::App& program);
Command add_export(CLI::App& program);
Command add_benchmark(CLI::App& program);
Command add_simulate(CLI::App& program);
Command add_infer(CLI::App& program);
/// These two tell of all commands: they are called when the others have been added, or later.
Command add_manual(CLI::App& program);
Command add_completion(CLI::App& program);

/// The program: finds the command in its arguments and does its work. Throws ConfigError for bad
/// usage, and what the work throws.
ExitCode run_program(int argc, char** argv);

/// Writes to standard output. A reader who has gone away is no mistake of ours; else throws Error.
ExitCode print(const std::string& text);

}  // namespace gramloom
