#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/field_options.h"
#include "commands/map_files.h"
#include "commands/size_option.h"
#include "commands/with_progress.h"
#include "core/error.h"
#include "jobs/progress_bar.h"
#include "jobs/tile_picture.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct TileArguments {
  TileWork work;
  std::string picture;
  std::string output;
  std::string size;
  std::vector<std::string> maps;
  int max_side = 0;
  int threads = 0;
  bool quiet = false;
};

ExitCode tile(const TileArguments& arguments) {
  use_threads(arguments.threads);
  TileWork work = arguments.work;
  work.picture = arguments.picture;
  work.output = arguments.output;
  work.size = size_of("--size", arguments.size, longest_written_side);
  work.maps = named_maps(arguments.maps);
  if (arguments.max_side > 0) work.max_side = arguments.max_side;
  return with_progress(work.output.filename().string(), arguments.quiet,
                       [&](const Control& control, ProgressBar&) {
                         const TiledFiles tiled = tile_picture(work, control);
                         for (const std::string& note : tiled.notes)
                           print_message(fmt::format("note: {}", note));
                         std::string text;
                         for (const auto& file : tiled.files) text += file.string() + "\n";
                         return text;
                       });
}

}  // namespace

Command add_tile(CLI::App& program) {
  const auto arguments = std::make_shared<TileArguments>();
  TileWork& work = arguments->work;
  CLI::App* command = program.add_subcommand(
      "tile",
      "Cover a picture of any size with a small one, without repetition (the method 'tiling'); "
      "rows are written as they are made, so memory does not grow with the size");
  command->add_option("picture", arguments->picture, "the small picture")->required();
  command->add_option("--size", arguments->size, "of the result, pixels")
      ->required()
      ->type_name(size_notation);
  command->add_option("--output", arguments->output, "the result (.png, .tif, .exr, .jpg …)")
      ->required()
      ->type_name("FILE");
  add_repeated(*command, "--map", arguments->maps,
               "a map of the picture, tiled with it and written beside the result as FILE_NAME; "
               "can be repeated",
               "NAME=FILE");
  command
      ->add_option("--max-side", arguments->max_side,
                   "scale the picture's longer side down to this")
      ->check(CLI::Range(1, 65536))
      ->type_name("PIXELS");
  command->add_option("--seed", work.seed, "of the random numbers; 1")->type_name("N");
  add_word(*command, "--tile", work.tile, "edges of the result that meet; none");
  add_word(*command, "--pixel-type", work.pixel_type,
           "how the result stores a value (as the picture)");
  add_threads(*command, arguments->threads);
  command->add_flag("--quiet", arguments->quiet, "show no progress");
  add_field_options(*command, work.params, "Tiling");
  return {command, [arguments] { return tile(*arguments); }};
}

}  // namespace gramloom
