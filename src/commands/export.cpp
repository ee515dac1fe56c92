#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/export_model.h"
#include "commands/export_run.h"
#include "commands/usage.h"
#include "core/error.h"
#include "jobs/progress_bar.h"

namespace gramloom {

namespace {

struct ExportArguments {
  ExportWork run;
  ModelExport model;
  std::string from;
  std::string output;
  std::string target;
};

template <NamedEnum E>
std::vector<std::string> words_of() {
  return {enum_names<E>.begin(), enum_names<E>.end()};
}

// Whether `word` is one of the enum's, which `value` then is.
template <NamedEnum E>
bool is_word(const std::string& word, E& value) {
  const auto& words = enum_names<E>;
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return false;
  value = static_cast<E>(found - words.begin());
  return true;
}

ExitCode export_results(const ExportArguments& arguments) {
  ExportWork work = arguments.run;
  work.run = arguments.from;
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

ExitCode export_any(ExportArguments& arguments) {
  const bool folder = std::filesystem::is_directory(arguments.from);
  const bool for_models = is_word(arguments.target, arguments.model.target);
  const auto refuse = [&](const std::string& why) {
    throw ConfigError("export {}: {}", arguments.from, why);
  };
  if (!for_models) {
    is_word(arguments.target, arguments.run.target);
    if (std::filesystem::is_regular_file(arguments.from))
      refuse(fmt::format("--target {} exports the folder of a run; of a model's file there are {}",
                         arguments.target, fmt::join(enum_names<ModelTarget>, ", ")));
    if (!arguments.model.weights.empty()) refuse("--weights are of a model, not of a run");
    return export_results(arguments);
  }
  if (folder)
    refuse(fmt::format("is a folder; --target {} exports a model's file, runs are exported as {}",
                       arguments.target, fmt::join(enum_names<ExportTarget>, ", ")));
  if (!arguments.run.only.empty() || arguments.run.strength > 0)
    refuse("--only and --strength are of a run, not of a model");
  arguments.model.model = std::filesystem::path(arguments.from);
  arguments.model.output = arguments.output;
  export_model(arguments.model);
  return print(arguments.output + "\n");
}

}  // namespace

Command add_export(CLI::App& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = program.add_subcommand(
      "export",
      "Write the results of a run, with their maps, as materials for other programs; or a trained "
      "generator as code that makes its textures without gramloom");
  command
      ->add_option("from", arguments->from,
                   "folder of a run, or a generator: a file (.safetensors) or the name of one in "
                   "gramloom's models folder")
      ->required()
      ->type_name("DIR|MODEL");
  std::vector<std::string> targets = words_of<ExportTarget>();
  const auto of_models = words_of<ModelTarget>();
  targets.insert(targets.end(), of_models.begin(), of_models.end());
  command
      ->add_option("--target", arguments->target,
                   "of a run: gltf: glTF 2.0, on a ball and a plane; materialx: a "
                   "standard_surface. Of a generator: c: a file of C99; glsl: shaders of WebGL 2; "
                   "onnx: for onnxruntime and others")
      ->check(one_of(targets))
      ->required()
      ->type_name("");
  command->add_option("--output", arguments->output, "folder of the materials, or file of the code")
      ->required()
      ->type_name("DIR|FILE");
  command
      ->add_option("--only", arguments->run.only,
                   "of a run: only jobs whose exemplar/method or exemplar/method/seedN matches")
      ->type_name("GLOB");
  command
      ->add_option("--strength", arguments->run.strength,
                   "of a run: how high a height of 1 stands (pixels); as its [surface], or 8")
      ->check(CLI::Range(1e-3, 1e5))
      ->type_name("");
  command
      ->add_option("--weights", arguments->model.weights,
                   "of a generator of several materials: share of each, as 0.7,0.3; none: the "
                   "first alone")
      ->delimiter(',')
      ->type_name("");
  return {command, [arguments] { return export_any(*arguments); }};
}

}  // namespace gramloom
