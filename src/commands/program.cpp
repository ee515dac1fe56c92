#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "commands/command.h"
#include "commands/examples.h"
#include "commands/usage.h"
#include "core/error.h"
#include "jobs/machine.h"

namespace gramloom {

namespace {

// Of a command's --help, before what is said of the program.
std::string footer_of(const CLI::App& command) {
  std::string text = "Examples:";
  for (const std::string& line :
       CLI::detail::split(std::string(examples_of(command.get_name())), '\n'))
    text += "\n  " + line;
  return text;
}

}  // namespace

ExitCode run_program(int argc, char** argv) {
  CLI::App app("New textures from a small picture of one.", "gramloom");
  app.set_version_flag("--version", version_line());
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
  for (const Command& command : commands)
    command.app->footer([app = command.app] { return footer_of(*app); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion&) {
    return print(version_line() + "\n");
  } catch (const CLI::Success&) {
    // --help, of the program or of a command.
    const auto asked = app.get_subcommands();
    return print(asked.empty() ? app.help() : asked.front()->help(app.get_name()));
  } catch (const CLI::ParseError& error) {
    throw ConfigError("{} (see --help)", usage_mistake(app, error));
  }
  const auto asked = std::ranges::find(commands, app.get_subcommands().front(), &Command::app);
  return asked->work();
}

}  // namespace gramloom
