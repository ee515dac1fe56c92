#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/field_options.h"
#include "core/error.h"
#include "jobs/picture_maps.h"
#include "jobs/progress_bar.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct MapsArguments {
  MapWork work;
  std::string picture;
  std::string output;
  bool height = false;
  bool from_photo = false;
  int threads = 0;
};

// What the flags say that the picture is; a photograph's normals and occlusion are made unless
// others are asked for.
MapWork work_of(const MapsArguments& arguments) {
  MapWork work = arguments.work;
  work.picture = arguments.picture;
  work.output = arguments.output;
  if (arguments.height) work.source = MapSource::normal;
  if (arguments.from_photo) {
    work.source = MapSource::photo;
    if (maps_asked(work.maps).empty()) work.maps.normal = work.maps.occlusion = true;
  }
  if (work.source == MapSource::height && maps_asked(work.maps).empty())
    throw ConfigError(
        "maps {}: no map is asked for; there are --normal, --occlusion and --curvature of a height "
        "map, --height of a normal map, and --from-photo",
        arguments.picture);
  return work;
}

ExitCode write_maps(const MapsArguments& arguments) {
  use_threads(arguments.threads);
  const MadeMaps made = make_maps(work_of(arguments));
  for (const std::string& note : made.notes) print_message(fmt::format("note: {}", note));
  std::string text;
  for (const auto& file : made.files) text += file.string() + "\n";
  if (!made.config.empty()) text += "\n" + made.config;
  return print(text);
}

}  // namespace

Command add_maps(CLI::App& program) {
  const auto arguments = std::make_shared<MapsArguments>();
  MapWork& work = arguments->work;
  CLI::App* maps = program.add_subcommand(
      "maps", "Make maps of a height map, of a normal map, or a material of a photograph");
  maps->add_option("picture", arguments->picture, "a height map, a normal map or a photograph")
      ->required();
  CLI::Option* height = maps->add_flag("--height", arguments->height,
                                       "the picture is a normal map: make its height, and further "
                                       "maps of that");
  CLI::Option* photo =
      maps->add_flag(
              "--from-photo", arguments->from_photo,
              "the picture is a photograph: make its colours in even light, guess height and "
              "roughness, and print the lines of a config that use them")
          ->excludes(height);
  add_word(*maps, "--tile", work.tile, "axes on which the picture tiles");
  maps->add_option("--output", arguments->output, "folder of the maps (the picture's)")
      ->type_name("DIR");
  add_word(*maps, "--format", work.format, "file type of the maps");
  add_word(*maps, "--pixel-type", work.pixel_type, "how the maps store a value (as the picture)");
  add_threads(*maps, arguments->threads);
  add_field_options(*maps, work.maps, "Maps");
  for (CLI::Option* option : add_field_options(*maps, work.photo, "Of a photograph"))
    option->needs(photo);
  return {maps, [arguments] { return write_maps(*arguments); }};
}

}  // namespace gramloom
