// Arguments -> command -> exit code: the only place that catches everything and prints.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>

#include "commands/command.h"
#include "core/error.h"
#include "io/text_file.h"
#include "jobs/machine.h"
#include "jobs/progress_bar.h"

namespace {

using namespace gramloom;

// A parent may have closed our standard streams; a result's file must not get their numbers.
void keep_standard_streams_open() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDWR) == -1) std::_Exit(bad_usage);
}

ExitCode dispatch(int argc, char** argv) {
  CLI::App app("New textures from a small picture of one.", "gramloom");
  app.set_version_flag("--version", fmt::format("gramloom {}", version()));
  app.require_subcommand(1);
  app.footer(
      "Exit code: 0 all done; 1 a job failed or got worse; 2 bad usage or config; 130 "
      "interrupted.");
  const std::vector<Command> commands{add_make(app, {argv, argv + argc}),
                                      add_run(app, {argv, argv + argc}),
                                      add_new(app),
                                      add_train(app, {argv, argv + argc}),
                                      add_generate(app),
                                      add_check(app),
                                      add_list(app),
                                      add_score(app),
                                      add_report(app),
                                      add_pick(app),
                                      add_maps(app),
                                      add_preview(app),
                                      add_tile(app),
                                      add_fill(app),
                                      add_arrange(app),
                                      add_export(app),
                                      add_benchmark(app),
                                      add_simulate(app),
                                      add_infer(app),
                                      add_manual(app),
                                      add_completion(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion&) {
    return print(fmt::format("gramloom {}\n", version()));
  } catch (const CLI::Success&) {
    // --help, of the program or of a command.
    const auto asked = app.get_subcommands();
    return print(asked.empty() ? app.help() : asked.front()->help(app.get_name()));
  } catch (const CLI::ParseError& error) {
    throw ConfigError("{} (see --help)", error.what());
  }
  const auto asked = std::ranges::find(commands, app.get_subcommands().front(), &Command::app);
  return asked->work();
}

}  // namespace

int main(int argc, char** argv) {
  keep_standard_streams_open();
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond a limit is an error of its job
  try {
    return dispatch(argc, argv);
  } catch (const ConfigError& error) {
    print_message(error.what());
    return bad_usage;
  } catch (const std::bad_alloc&) {
    print_message("gramloom: out of memory");
  } catch (const std::exception& error) {
    print_message(fmt::format("gramloom: {}", first_line(error.what())));
  }
  return job_failed;
}
