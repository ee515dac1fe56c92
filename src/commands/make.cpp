#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/end_run.h"
#include "commands/field_options.h"
#include "commands/map_files.h"
#include "commands/size_option.h"
#include "commands/usage.h"
#include "commands/with_progress.h"
#include "core/error.h"
#include "core/spinning.h"
#include "jobs/make_texture.h"
#include "jobs/progress_bar.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct MakeArguments {
  MakeWork work;
  std::string output;
  std::string size;
  std::vector<std::string> maps;
  int max_side = 0;
  int threads = 0;
  bool no_maps = false;
  bool print_config = false;
  bool quiet = false;
  std::vector<std::string> words;  // the command line itself
};

MakeWork work_of(const MakeArguments& arguments) {
  MakeWork work = arguments.work;
  work.output = arguments.output;
  if (!arguments.size.empty()) work.size = size_of("--size", arguments.size);
  if (arguments.max_side > 0) work.max_side = arguments.max_side;
  work.maps = named_maps(arguments.maps);
  work.finds_maps = !arguments.no_maps;
  if (!work.maps.empty() && work.exemplars.size() > 1)
    throw ConfigError("--map: is of one exemplar, not of several; a config can give each its own");
  return work;
}

ExitCode make(const MakeArguments& arguments) {
  keep_large_buffers();
  use_threads(arguments.threads);
  const MakeWork work = work_of(arguments);
  if (arguments.print_config) return print(config_of(work));
  if (work.output.empty()) throw ConfigError("make: --output or --print-config is needed");
  bound_spinning(arguments.words);
  return with_progress(work.output.filename().string(), arguments.quiet,
                       [&](const Control& control, ProgressBar&) {
                         const MadeFiles made = make_texture(work, control);
                         for (const std::string& note : made.notes)
                           print_message(fmt::format("note: {}", note));
                         std::string text;
                         for (const auto& file : made.files) text += file.string() + "\n";
                         return text;
                       });
}

}  // namespace

Command add_make(CLI::App& program, const std::vector<std::string>& words) {
  const auto arguments = std::make_shared<MakeArguments>();
  arguments->words = words;
  MakeWork& work = arguments->work;
  CLI::App* command = program.add_subcommand(
      "make",
      "Make one texture of a picture. By default by the method 'neural' with its preset 'fast', "
      "512 pixels wide and high, to tile: about ten seconds on two cores");
  command
      ->add_option("exemplars", work.exemplars,
                   "a picture of the material, or several; or the name of a procedural texture")
      ->required();
  command
      ->add_option("--output", arguments->output,
                   "the result (.png, .tif, .exr or .jpg); maps go to FILE_NAME beside it")
      ->type_name("FILE");
  command->add_option("--size", arguments->size, "of the result, pixels; 512")
      ->type_name(size_notation);
  add_word(*command, "--tile", work.tile, "edges of the result that meet; both");
  const auto kinds = methods_with(Ability::exemplar);
  command->add_option("--kind", work.kind, "kind of the method; neural")
      ->check(one_of({kinds.begin(), kinds.end()}))
      ->type_name("");
  add_word(*command, "--preset", work.preset,
           "settings of neural; fast. balanced takes five times as long, quality ten times");
  command->add_option("--seed", work.seed, "of the random numbers; 1")
      ->check(CLI::Range(0, 2147483647))
      ->type_name("N");
  CLI::Option* maps = add_repeated(
      *command, "--map", arguments->maps,
      "a map of the exemplar, made together with it; can be repeated. Without it, those beside one "
      "picture are: wall_height.png, wall_normal.png of wall.png",
      "NAME=FILE");
  command->add_flag("--no-maps", arguments->no_maps, "leave those beside the picture out")
      ->excludes(maps);
  command
      ->add_option(
          "--max-side", arguments->max_side,
          "scale the exemplars' longer sides down to this; 1024, or the result's longer side")
      ->check(CLI::Range(1, longest_side))
      ->type_name("PIXELS");
  add_repeated(*command, "--set", work.set,
               "a parameter of the method (see gramloom list methods); can be repeated",
               "KEY=VALUE");
  add_threads(*command, arguments->threads);
  command->add_flag("--print-config", arguments->print_config,
                    "print the config that does the same, and nothing else");
  command->add_flag("--quiet", arguments->quiet, "show no progress");
  return {command, [arguments] { return make(*arguments); }};
}

}  // namespace gramloom
