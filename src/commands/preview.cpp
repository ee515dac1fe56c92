#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/field_options.h"
#include "commands/map_files.h"
#include "commands/with_progress.h"
#include "core/error.h"
#include "jobs/preview_files.h"
#include "jobs/progress_bar.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct PreviewArguments {
  PreviewWork work;
  std::vector<std::string> maps;
  std::string output;
  int threads = 0;
  bool quiet = false;
};

ExitCode preview_pictures(const PreviewArguments& arguments) {
  use_threads(arguments.threads);
  PreviewWork work = arguments.work;
  work.maps = named_maps(arguments.maps);
  return with_progress("preview", arguments.quiet, [&](const Control& control, ProgressBar& bar) {
    const PreviewFile made = make_preview(work, arguments.output, control);
    for (const std::string& line : made.used) bar.message(line);
    return arguments.output + "\n";
  });
}

}  // namespace

Command add_preview(CLI::App& program) {
  const auto arguments = std::make_shared<PreviewArguments>();
  CLI::App* preview =
      program.add_subcommand("preview", "Show a texture on a shape under a lamp, with its maps");
  preview->add_option(
      "images", arguments->work.images,
      "the texture; its maps may follow (name_height.png, name_normal.png, …) or lie "
      "beside it; a second texture shares the shape by a pattern; or the name of a "
      "procedural texture; or, with --mapping solid, slices of a volume; or none: maps of a "
      "surface in one colour");
  preview->add_option("--output", arguments->output, "the picture to write")
      ->required()
      ->type_name("FILE");
  add_repeated(*preview, "--map", arguments->maps,
               "a map of the first texture, its name and file: height, normal, roughness, "
               "metalness or occlusion",
               "NAME=FILE");
  add_repeated(*preview, "--set", arguments->work.set, "a parameter of the procedural textures",
               "KEY=VALUE");
  add_field_options(*preview, arguments->work.params, "The picture");
  add_threads(*preview, arguments->threads);
  preview->add_flag("--quiet", arguments->quiet, "show no progress");
  return {preview, [arguments] { return preview_pictures(*arguments); }};
}

}  // namespace gramloom
