#include "jobs/overrides.h"

#include <algorithm>

#include "io/toml_reader.h"
#include "jobs/config.h"
#include "jobs/method_reader.h"

namespace gramloom {

namespace {

bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

void assign(toml::table& table, std::string_view key, std::string_view value,
            const std::string& option) {
  toml::table given = parse_override(key, value, option);
  const auto found = given.find(key);
  table.erase(key);  // or the key would keep its old place
  table.insert(found->first, std::move(found->second));
}

// The table of `tables` whose name is `name`.
toml::table& named_table(const std::vector<toml::table*>& tables, std::string_view kind,
                         const std::string& name, const std::string& option) {
  std::vector<std::string> names;
  for (toml::table* table : tables) {
    names.push_back((*table)["name"].value_or(std::string()));
    if (names.back() == name) return *table;
  }
  const std::string guess = closest_word(name, names);
  throw ConfigError("--set {}: no {} is called '{}' ({})", option, kind, name,
                    guess.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean '{}'?", guess));
}

// "method.NAME.key": into one table of a section; a name may have dots. False: not of this form.
bool assign_in_section(toml::table& config, std::string_view kind, const std::string& path,
                       std::string_view value, const std::string& option) {
  const std::size_t first = path.find('.');
  const std::size_t last = path.rfind('.');
  if (path.substr(0, first) != kind || first == last) return false;
  const std::string name = path.substr(first + 1, last - first - 1);
  assign(named_table(section(config, kind), kind, name, option), path.substr(last + 1), value,
         option);
  return true;
}

// "baseline.key": into that table. False: not of this form.
bool assign_in_baseline(toml::table& config, const std::string& path, std::string_view value,
                        const std::string& option) {
  constexpr std::string_view prefix = "baseline.";
  if (!path.starts_with(prefix)) return false;
  if (!single_section(config, "baseline")) config.insert("baseline", toml::table());
  assign(*single_section(config, "baseline"), path.substr(prefix.size()), value, option);
  return true;
}

// Into every method that has the key.
void assign_in_methods(toml::table& config, const std::string& key, std::string_view value,
                       const std::string& option) {
  std::vector<std::string> known = config_keys();
  bool found = false;
  for (toml::table* method : section(config, "method")) {
    const auto keys = method_keys(*method);
    known.insert(known.end(), keys.begin(), keys.end());
    if (!contains(keys, key) || key == "name") continue;
    assign(*method, key, value, option);
    found = true;
  }
  if (found) return;
  const std::string guess = closest_word(key, known);
  throw ConfigError("--set {}: unknown key '{}'{}", option, key,
                    guess.empty() ? " in this config and its methods"
                                  : fmt::format(" (did you mean '{}'?)", guess));
}

}  // namespace

std::vector<std::string> config_keys() { return key_names<Config>(); }

std::vector<toml::table*> section(toml::table& config, std::string_view name) {
  std::vector<toml::table*> tables;
  toml::node* node = config.get(name);
  if (!node) return tables;
  if (!node->is_array_of_tables())
    fail(key_region(config, name), "'{}' must be a list of tables: [[{}]]", name, name);
  for (auto& element : *node->as_array()) tables.push_back(element.as_table());
  return tables;
}

toml::table* single_section(toml::table& config, std::string_view name) {
  toml::node* node = config.get(name);
  if (node && !node->is_table())
    fail(key_region(config, name), "'{}' must be a table: [{}]", name, name);
  return node ? node->as_table() : nullptr;
}

void apply_override(toml::table& config, const std::string& option) {
  const std::size_t equals = option.find('=');
  if (equals == std::string::npos || equals == 0)
    throw ConfigError("--set {}: must be key=value", option);
  const std::string key = option.substr(0, equals);
  const std::string value = option.substr(equals + 1);
  if (contains(config_keys(), key))
    assign(config, key, value, option);
  else if (!assign_in_section(config, "method", key, value, option) &&
           !assign_in_section(config, "exemplar", key, value, option) &&
           !assign_in_baseline(config, key, value, option))
    assign_in_methods(config, key, value, option);
}

}  // namespace gramloom
