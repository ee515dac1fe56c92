#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/usage.h"
#include "commands/with_progress.h"
#include "core/error.h"
#include "jobs/infer_pictures.h"
#include "jobs/progress_bar.h"

namespace gramloom {

namespace {

struct InferArguments {
  InferWork work;
  std::string model;
  std::string poses;
  std::string output;
  bool quiet = false;
};

ExitCode infer_files(const InferArguments& arguments) {
  InferWork work = arguments.work;
  work.model = FileOrName(arguments.model);
  work.poses = arguments.poses;
  work.output = arguments.output;
  if (work.pose.empty() && work.poses.empty())
    throw ConfigError("infer: needed is --pose or --poses (see --help)");
  return with_progress("infer", arguments.quiet, [&](const Control& control, ProgressBar&) {
    const InferredFiles inferred = infer_pictures(work, control);
    for (const std::string& note : inferred.notes) print_message(fmt::format("note: {}", note));
    std::string text;
    for (const auto& file : inferred.files) text += file.string() + "\n";
    return text;
  });
}

}  // namespace

Command add_infer(CLI::App& program) {
  const auto arguments = std::make_shared<InferArguments>();
  InferWork& work = arguments->work;
  CLI::App* command = program.add_subcommand(
      "infer",
      "Infer the picture of a pose, such as the folds of a sleeve, by a model that 'train' has "
      "made; or a picture each of many poses");
  command->add_option("model", arguments->model, "a model's file (.safetensors)")->required();
  CLI::Option* pose =
      command->add_option("--pose", work.pose, "the model's numbers, in their order")
          ->type_name("A,B,…");
  CLI::Option* to =
      command
          ->add_option("--to", work.to,
                       "last pose of a sequence that begins with --pose; into a folder")
          ->needs(pose)
          ->type_name("A,B,…");
  command->add_option("--frames", work.frames, "of that sequence; 24")
      ->needs(to)
      ->check(CLI::Range(1, 9999))
      ->type_name("N");
  command
      ->add_option("--poses", arguments->poses,
                   "a table (CSV) of poses, columns named like the model's numbers; into a folder")
      ->excludes(pose)
      ->type_name("FILE");
  command
      ->add_option("--output", arguments->output,
                   "the picture (.exr, .tif, .png …); of several, their folder: frame_0001.exr …")
      ->required()
      ->type_name("FILE");
  command->add_option("--format", work.format, "file type of pictures in a folder; exr")
      ->check(one_of({"exr", "tif", "png", "jpg"}))
      ->type_name("");
  command->add_flag("--extrapolate", work.extrapolates,
                    "poses outside the ranges that were learnt too");
  command->add_flag("--quiet", arguments->quiet, "show no progress");
  return {command, [arguments] { return infer_files(*arguments); }};
}

}  // namespace gramloom
