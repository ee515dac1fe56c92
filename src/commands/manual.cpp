#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "commands/command.h"
#include "commands/manual_pages.h"
#include "core/error.h"
#include "io/text_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// As man looks for them: FOLDER/man1/gramloom-run.1.
ExitCode write_manual(const CLI::App& program, const fs::path& folder) {
  for (const ManualPage& page : manual_pages(program)) {
    const fs::path section = folder / fmt::format("man{}", page.section);
    std::error_code failure;
    fs::create_directories(section, failure);
    if (failure) throw Error("{}: {}", section.string(), failure.message());
    write_text(section / fmt::format("{}.{}", page.name, page.section), manual_text(program, page));
  }
  return all_done;
}

ExitCode manual(const CLI::App& program, const std::string& wanted, const std::string& folder) {
  if (!folder.empty()) return write_manual(program, folder);
  const std::vector<ManualPage> pages = manual_pages(program);
  const auto page = std::ranges::find(pages, wanted, &ManualPage::name);
  if (page != pages.end()) return print(manual_text(program, *page));
  std::vector<std::string> names;
  for (const ManualPage& known : pages) names.push_back(known.name);
  throw ConfigError("manual: there is no page '{}', there are {}", wanted, fmt::join(names, ", "));
}

}  // namespace

Command add_manual(CLI::App& program) {
  const auto page = std::make_shared<std::string>("gramloom");
  const auto folder = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand(
      "manual", "Print a page of the manual as roff: gramloom manual gramloom-config | man -l -");
  command->add_option("page", *page, "gramloom, gramloom-COMMAND or gramloom-config; gramloom");
  command->add_option("--output", *folder, "write all pages into this folder, in man1 and man5")
      ->type_name("DIR");
  return {command, [&program, page, folder] { return manual(program, *page, *folder); }};
}

}  // namespace gramloom
