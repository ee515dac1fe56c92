#include "commands/config_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "jobs/runner.h"

namespace gramloom {

void add_config_options(CLI::App& command, ConfigOptions& options) {
  command.add_option("config", options.config, "config file (TOML)")->required();
  command
      .add_option(
          "--only", options.only,
          "only jobs whose exemplar/method or exemplar/method/seedN matches, and models to train "
          "whose exemplar/model does (of an inference its name): * stands for any letters, ? for "
          "one, all else for itself")
      ->type_name("GLOB");
  add_repeated(command, "--set", options.set,
               "in place of what the config says: a top-level key, a parameter of every method "
               "that has it, method.NAME.key, exemplar.NAME.key or model.NAME.key",
               "KEY=VALUE");
}

CLI::Option* add_repeated(CLI::App& command, const std::string& option,
                          std::vector<std::string>& values, const std::string& meaning,
                          const std::string& type) {
  return command.add_option(option, values, meaning)
      ->type_name(type)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option* add_spread_options(CLI::App& command, SpreadOptions& options) {
  CLI::Option* shard =
      command
          .add_option("--shard", options.shard,
                      "do the K-th of N parts of the jobs, others do the rest into the same "
                      "folder, also on "
                      "other machines; alone, in a task of a Slurm array: that task's part")
          ->type_name("[K/N]")
          ->expected(0, 1);
  command
      .add_option("--jobs", options.jobs,
                  "so many jobs at once, each in a process of its own; 0: as many as threads")
      ->type_name("N")
      ->check(CLI::Range(0, most_jobs));
  return shard;
}

// Many more threads than cores bring the work to a halt; some more must be allowed, as results of
// neural methods depend on the number.
void add_threads(CLI::App& command, int& threads) {
  const int most = 8 * static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  command.add_option("--threads", threads, "threads; 0: every core")
      ->type_name("N")
      ->check(CLI::Range(0, most));
}

}  // namespace gramloom
