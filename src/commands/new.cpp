#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "jobs/new_config.h"

namespace gramloom {

namespace {

struct NewArguments {
  std::string file;
  std::vector<std::string> from;
};

ExitCode write_config(const NewArguments& arguments) {
  write_new_config(arguments.file, {arguments.from.begin(), arguments.from.end()});
  return print(arguments.file + "\n");
}

}  // namespace

Command add_new(CLI::App& program) {
  const auto arguments = std::make_shared<NewArguments>();
  CLI::App* command = program.add_subcommand(
      "new",
      "Write a commented config to start from: sizes, exemplars, three methods, and other keys "
      "with their defaults. A file that is there stays as it is");
  command->add_option("config", arguments->file, "the config to write (.toml)")->required();
  command
      ->add_option("--from", arguments->from,
                   "photographs of materials, each an exemplar, or folders of some; the pebbles "
                   "that come with gramloom")
      ->type_name("PICTURE|DIR ...");
  return {command, [arguments] { return write_config(*arguments); }};
}

}  // namespace gramloom
