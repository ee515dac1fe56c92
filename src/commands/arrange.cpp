#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "jobs/arrange_pictures.h"
#include "jobs/progress_bar.h"

namespace gramloom {

namespace {

struct ArrangeArguments {
  std::string coordinates;
  std::vector<std::string> pictures;
  std::string output;
};

ExitCode arrange(const ArrangeArguments& arguments) {
  ArrangeWork work{arguments.coordinates, {}, arguments.output};
  work.pictures.assign(arguments.pictures.begin(), arguments.pictures.end());
  for (const std::string& note : arrange_pictures(work))
    print_message(fmt::format("note: {}: {}", work.output.filename().string(), note));
  return print(arguments.output + "\n");
}

}  // namespace

Command add_arrange(CLI::App& program) {
  const auto arguments = std::make_shared<ArrangeArguments>();
  CLI::App* command = program.add_subcommand(
      "arrange",
      "Lay other pictures as a texture's pixels lie: its coordinates (coordinates = true in a "
      "config) say where each was copied from; no value is changed");
  command->add_option("coordinates", arguments->coordinates, "seedN_coordinates.tif of a run")
      ->required();
  command
      ->add_option("pictures", arguments->pictures,
                   "a picture for each of the exemplar, as large as that, in their order; of a "
                   "picture filled of others, that one last")
      ->required();
  command->add_option("--output", arguments->output, "the result (.png, .tif, .exr …)")
      ->required()
      ->type_name("FILE");
  return {command, [arguments] { return arrange(*arguments); }};
}

}  // namespace gramloom
