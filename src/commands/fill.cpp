#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/field_options.h"
#include "commands/with_progress.h"
#include "core/error.h"
#include "jobs/fill_picture.h"
#include "jobs/progress_bar.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct FillArguments {
  FillWork work;
  std::string picture;
  std::string mask;
  std::string output;
  std::vector<std::string> from;
  int threads = 0;
  bool print_config = false;
  bool quiet = false;
};

ExitCode fill(const FillArguments& arguments) {
  use_threads(arguments.threads);
  FillWork work = arguments.work;
  work.picture = arguments.picture;
  work.mask = arguments.mask;
  work.output = arguments.output;
  work.from.assign(arguments.from.begin(), arguments.from.end());
  if (arguments.print_config) return print(config_of(work));
  if (work.output.empty()) throw ConfigError("fill: --output or --print-config is needed");
  return with_progress(work.output.filename().string(), arguments.quiet,
                       [&](const Control& control, ProgressBar&) {
                         for (const std::string& note : fill_picture(work, control))
                           print_message(fmt::format("note: {}", note));
                         return arguments.output + "\n";
                       });
}

}  // namespace

Command add_fill(CLI::App& program) {
  const auto arguments = std::make_shared<FillArguments>();
  FillWork& work = arguments->work;
  CLI::App* command = program.add_subcommand(
      "fill",
      "Make a part of a picture anew, of the rest of it or of other pictures; the rest stays as it "
      "is, byte for byte");
  command->add_option("picture", arguments->picture, "the picture")->required();
  command
      ->add_option("--mask", arguments->mask,
                   "a picture of its size: white is made anew; or alpha: where it is transparent")
      ->type_name("FILE");
  command->add_option("--output", arguments->output, "the result (.png, .tif, .exr …)")
      ->type_name("FILE");
  add_word(*command, "--seamless", work.seamless, "make the edges anew, so that these meet; none");
  command->add_option("--band", work.band, "width of that band on each side; an eighth, 64 at most")
      ->check(CLI::Range(1, 65536))
      ->type_name("PIXELS");
  command
      ->add_option("--extend", work.extend,
                   "add pixels on the left, top, right and bottom, or as many on each side")
      ->delimiter(',')
      ->check(CLI::Range(0, 65536))
      ->type_name("L,T,R,B");
  command
      ->add_option("--blend", work.blend,
                   "how far from what stays colours that are copied are fitted to it; 4; 0: they "
                   "stay copies")
      ->check(CLI::Range(0, 16))
      ->type_name("PIXELS");
  add_repeated(*command, "--from", arguments->from,
               "fill with what this picture shows, not the picture itself; can be repeated",
               "FILE");
  command->add_option("--method", work.method, "kind of the method that fills; patchmatch")
      ->type_name("KIND");
  command->add_option("--seed", work.seed, "of the random numbers; 1")
      ->check(CLI::Range(0, 2147483647))
      ->type_name("N");
  add_threads(*command, arguments->threads);
  command->add_flag("--print-config", arguments->print_config,
                    "print the config that does the same, and nothing else");
  command->add_flag("--quiet", arguments->quiet, "show no progress");
  return {command, [arguments] { return fill(*arguments); }};
}

}  // namespace gramloom
