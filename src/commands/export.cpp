#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/export_run.h"
#include "commands/field_options.h"
#include "jobs/progress_bar.h"

namespace gramloom {

namespace {

struct ExportArguments {
  ExportWork work;
  std::string run;
  std::string output;
};

ExitCode export_results(const ExportArguments& arguments) {
  ExportWork work = arguments.work;
  work.run = arguments.run;
  work.output = arguments.output;
  const Exported exported = export_run(work);
  for (const std::string& note : exported.notes) print_message(fmt::format("note: {}", note));
  for (const std::string& failure : exported.failures)
    print_message(fmt::format("gramloom: {}", failure));
  std::string text;
  for (const auto& document : exported.documents) text += document.string() + "\n";
  print(text);
  return exported.failures.empty() ? all_done : job_failed;
}

}  // namespace

Command add_export(CLI::App& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = program.add_subcommand(
      "export", "Write the results of a run, with their maps, as materials for other programs");
  command->add_option("folder", arguments->run, "folder of a run")->required()->type_name("DIR");
  add_word(*command, "--target", arguments->work.target,
           "gltf: glTF 2.0, on a ball and a plane; materialx: a standard_surface")
      ->required();
  command->add_option("--output", arguments->output, "folder of the materials")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("--only", arguments->work.only,
                   "only jobs whose exemplar/method or exemplar/method/seedN matches")
      ->type_name("GLOB");
  command
      ->add_option("--strength", arguments->work.strength,
                   "how high a height of 1 stands (pixels); as the run's [surface], or 8")
      ->check(CLI::Range(1e-3, 1e5))
      ->type_name("");
  return {command, [arguments] { return export_results(*arguments); }};
}

}  // namespace gramloom
