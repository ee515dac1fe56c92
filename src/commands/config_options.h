#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gramloom {

/// What commands that read a config are told: the file, what is put in its place, and which of its
/// jobs are meant.
struct ConfigOptions {
  std::string config;
  std::string only;
  std::vector<std::string> set;
};

/// `options` must stay where it is until the command line is read.
void add_config_options(CLI::App& command, ConfigOptions& options);

/// An option that can be repeated, each time with one value; likewise.
CLI::Option* add_repeated(CLI::App& command, const std::string& option,
                          std::vector<std::string>& values, const std::string& meaning,
                          const std::string& type);

/// --shard and --jobs; likewise.
struct SpreadOptions {
  std::string shard;

  int jobs = 1;
};
CLI::Option* add_spread_options(CLI::App& command, SpreadOptions& options);  // --shard

/// --threads; likewise.
void add_threads(CLI::App& command, int& threads);

}  // namespace gramloom
