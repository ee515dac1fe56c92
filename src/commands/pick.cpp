#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "jobs/pick_results.h"

namespace gramloom {

namespace {

struct PickArguments {
  std::string run;
  std::vector<std::string> names;
  std::string list;
  std::string output;
};

ExitCode pick(const PickArguments& arguments) {
  std::string text;
  for (const auto& file :
       pick_results({arguments.run, arguments.names, arguments.list, arguments.output}))
    text += file.string() + "\n";
  return print(text);
}

}  // namespace

Command add_pick(CLI::App& program) {
  const auto arguments = std::make_shared<PickArguments>();
  CLI::App* command = program.add_subcommand(
      "pick",
      "Copy results of a run into a folder of their own, each with its maps and a config that "
      "makes "
      "it again. The page of a run shows this command for the pictures that are picked there");
  command->add_option("folder", arguments->run, "folder of a run")->required()->type_name("DIR");
  command->add_option("names", arguments->names,
                      "what to pick: names of jobs, as exemplar/method/seed1");
  command->add_option("--list", arguments->list, "a text with names, a line each")
      ->type_name("FILE");
  command
      ->add_option("--output", arguments->output,
                   "folder of what is picked: new, empty, or an earlier one, which is replaced")
      ->required()
      ->type_name("DIR");
  return {command, [arguments] { return pick(*arguments); }};
}

}  // namespace gramloom
