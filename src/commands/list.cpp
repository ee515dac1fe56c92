#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "jobs/listing.h"

namespace gramloom {

namespace {

ExitCode list_topic(const std::string& chosen) {
  const auto wanted = [&](std::string_view topic) { return chosen.empty() || chosen == topic; };
  std::string text;
  if (wanted("methods")) text += list_methods();
  if (wanted("abilities")) text += list_abilities() + "\n";
  if (wanted("direction")) text += list_direction();
  if (wanted("networks")) text += list_networks();
  if (wanted("models")) text += list_models();
  if (wanted("patterns")) text += list_patterns();
  if (wanted("metrics")) text += list_metrics();
  if (wanted("maps")) text += list_maps();
  if (wanted("simulation")) text += list_simulation();
  return print(text);
}

}  // namespace

Command add_list(CLI::App& program) {
  const auto topic = std::make_shared<std::string>();
  CLI::App* list = program.add_subcommand(
      "list", "List methods, what they can be asked, and what else there is");
  const std::vector<std::string> topics{"methods",  "abilities", "direction", "networks",  "models",
                                        "patterns", "metrics",   "maps",      "simulation"};
  list->add_option("topic", *topic, fmt::format("one of {}", fmt::join(topics, ", ")))
      ->check(CLI::IsMember(topics));
  return {list, [topic] { return list_topic(*topic); }};
}

}  // namespace gramloom
