#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/usage.h"
#include "core/error.h"
#include "jobs/key_lists.h"
#include "jobs/listing.h"

namespace gramloom {

namespace {

// A list as a text, and as JSON.
struct Topic {
  std::string name;
  std::string (*text)();
  Json (*json)();
};

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all{
      {"methods", list_methods, [] { return to_json_value(method_lists()); }},
      {"abilities", [] { return list_abilities() + "\n"; }, abilities_json},
      {"direction", list_direction, [] { return to_json_value(direction_lists()); }},
      {"networks", list_networks, networks_json},
      {"models", list_models, models_json},
      {"patterns", list_patterns, [] { return to_json_value(texture_lists()); }},
      {"metrics", list_metrics, metrics_json},
      {"maps", list_maps, [] { return to_json_value(map_lists()); }},
      {"simulation", list_simulation, [] { return to_json_value(simulation_lists()); }}};
  return all;
}

ExitCode list_topic(const std::string& chosen, bool as_json) {
  std::string text;
  Json all;
  for (const Topic& topic : topics()) {
    if (!chosen.empty() && chosen != topic.name) continue;
    if (as_json)
      all[topic.name] = topic.json();
    else
      text += topic.text();
  }
  if (!as_json) return print(text);
  return print(to_text(chosen.empty() ? all : all[chosen], 2) + "\n");
}

}  // namespace

Command add_list(CLI::App& program) {
  const auto topic = std::make_shared<std::string>();
  const auto as_json = std::make_shared<bool>(false);
  CLI::App* list = program.add_subcommand(
      "list", "List methods, what they can be asked, and what else there is");
  std::vector<std::string> names;
  for (const Topic& one : topics()) names.push_back(one.name);
  list->add_option("topic", *topic, "which list; all")->check(one_of(names));
  list->add_flag("--json", *as_json, "for programs: with types, limits and words");
  return {list, [topic, as_json] { return list_topic(*topic, *as_json); }};
}

}  // namespace gramloom
