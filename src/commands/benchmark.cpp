#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/config_options.h"
#include "core/error.h"
#include "jobs/benchmark_table.h"
#include "jobs/progress_bar.h"
#include "signal/opencv_threads.h"

namespace gramloom {

namespace {

struct BenchmarkArguments {
  std::string folder;
  std::vector<std::string> peers;
  std::string against;
  bool markdown = false;
  bool json = false;
  int threads = 0;
};

ExitCode compare_methods(const BenchmarkArguments& arguments) {
  use_threads(arguments.threads);
  std::vector<Peer> peers;
  for (const std::string& option : arguments.peers) peers.push_back(parse_peer(option));
  const RunOnDisk run = read_named_run(arguments.folder);
  const Benchmark benchmark = benchmark_run(run, score_peers(run, peers, {}), arguments.against);
  for (const std::string& line : benchmark.missing) print_message("gramloom: " + line);
  const TableStyle style = arguments.markdown ? TableStyle::markdown : TableStyle::plain;
  print(arguments.json ? benchmark_json(benchmark) : benchmark_table(benchmark, style));
  return benchmark.missing.empty() ? all_done : job_failed;
}

}  // namespace

Command add_benchmark(CLI::App& program) {
  const auto arguments = std::make_shared<BenchmarkArguments>();
  CLI::App* command = program.add_subcommand(
      "benchmark", "Compare the methods of a run, a line each, and pictures of other programs");
  command->add_option("folder", arguments->folder, "folder of a run")->required()->type_name("DIR");
  add_repeated(*command, "--peer", arguments->peers,
               "pictures of another program, called like the exemplars: FOLDER/pebbles.png, or "
               "several in FOLDER/pebbles",
               "NAME=FOLDER");
  command
      ->add_option("--against", arguments->against,
                   "a method or peer: others as differences from it, exemplar by exemplar")
      ->type_name("NAME");
  CLI::Option* json = command->add_flag("--json", arguments->json, "JSON in place of a table");
  command->add_flag("--markdown", arguments->markdown, "a table of Markdown")->excludes(json);
  add_threads(*command, arguments->threads);
  return {command, [arguments] { return compare_methods(*arguments); }};
}

}  // namespace gramloom
