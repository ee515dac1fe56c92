#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "commands/usage.h"
#include "io/field_values.h"
#include "jobs/progress_bar.h"
#include "jobs/score_files.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct ScoreArguments {
  std::string exemplar;
  std::vector<std::string> images;
  std::string tile = "none";
  bool json = false;
  bool controls = false;
  int threads = 0;
};

ExitCode score_pictures(const ScoreArguments& arguments) {
  use_threads(arguments.threads);
  constexpr auto names = enum_names<Tile>;
  static_assert(NamedEnum<Tile>);
  const Tile tile =
      static_cast<Tile>(std::find(names.begin(), names.end(), arguments.tile) - names.begin());
  const auto scored =
      score_files(arguments.exemplar, arguments.images, tile, arguments.controls, {});
  ExitCode code = all_done;
  for (const ScoredImage& image : scored) {
    if (image.error.empty()) continue;
    print_message(fmt::format("gramloom: {}", image.error));
    code = job_failed;
  }
  print(arguments.json ? score_json(scored) : score_table(scored));
  return code;
}

}  // namespace

Command add_score(CLI::App& program) {
  const auto arguments = std::make_shared<ScoreArguments>();
  CLI::App* score = program.add_subcommand(
      "score", "Score pictures, of gramloom or not, against the exemplar they were made from");
  score->add_option("exemplar", arguments->exemplar, "the exemplar's file")->required();
  score->add_option("images", arguments->images, "pictures to score")->required();
  score->add_flag("--json", arguments->json, "JSON in place of a table");
  score->add_flag("--controls", arguments->controls,
                  "score pictures with known faults beside them: shuffled pixels, random phase, "
                  "the exemplar tiled, its halves");
  score->add_option("--tile", arguments->tile, "axes on which the pictures tile, for the seams")
      ->check(one_of({"none", "x", "y", "both"}));
  add_threads(*score, arguments->threads);
  return {score, [arguments] { return score_pictures(*arguments); }};
}

}  // namespace gramloom
