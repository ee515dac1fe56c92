#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/field_options.h"
#include "commands/size_option.h"
#include "commands/with_progress.h"
#include "jobs/generate_picture.h"
#include "jobs/progress_bar.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct GenerateArguments {
  GenerateWork work;
  std::string model;
  std::string output;
  std::string size;
  std::string weight_picture;
  int threads = 0;
  bool quiet = false;
};

ExitCode generate_file(const GenerateArguments& arguments) {
  use_threads(arguments.threads);
  GenerateWork work = arguments.work;
  work.params.model = FileOrName(arguments.model);
  work.params.weight_picture = arguments.weight_picture;
  work.output = arguments.output;
  work.size = size_of("--size", arguments.size, longest_written_side);
  return with_progress(work.output.filename().string(), arguments.quiet,
                       [&](const Control& control, ProgressBar&) {
                         const GeneratedFiles generated = generate_picture(work, control);
                         for (const std::string& note : generated.notes)
                           print_message(fmt::format("note: {}", note));
                         std::string text;
                         for (const auto& file : generated.files) text += file.string() + "\n";
                         return text;
                       });
}

}  // namespace

Command add_generate(CLI::App& program) {
  const auto arguments = std::make_shared<GenerateArguments>();
  GenerateWork& work = arguments->work;
  CLI::App* command = program.add_subcommand(
      "generate",
      "Make a picture of any size by a trained generator; rows are written as they are made, so "
      "memory does not grow with the height");
  command
      ->add_option("model", arguments->model,
                   "a model's file (.safetensors), or the name of one of gramloom's")
      ->required();
  command->add_option("--size", arguments->size, "of the result, pixels")
      ->required()
      ->type_name(size_notation);
  command
      ->add_option("--output", arguments->output,
                   "the result (.png, .tif, .exr, .jpg …); maps go to FILE_NAME beside it")
      ->required()
      ->type_name("FILE");
  command->add_option("--seed", work.seed, "of the random numbers; 1")
      ->check(CLI::Range(0, 2147483647))
      ->type_name("N");
  add_word(*command, "--tile", work.tile, "edges of the result that meet; none");
  command->add_option("--weights", work.params.weights, "share of each material of a blend")
      ->delimiter(',')
      ->type_name("A,B,…");
  command
      ->add_option(
          "--weight-picture", arguments->weight_picture,
          "a picture of shares, stretched over the result: from the first material (black) "
          "to the second, or a channel a material")
      ->type_name("FILE");
  add_word(*command, "--pixel-type", work.pixel_type, "how the result stores a value");
  add_threads(*command, arguments->threads);
  command->add_flag("--quiet", arguments->quiet, "show no progress");
  return {command, [arguments] { return generate_file(*arguments); }};
}

}  // namespace gramloom
