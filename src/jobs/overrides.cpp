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

std::string name_of(const toml::table& table) { return table["name"].value_or(std::string()); }

// Says which names there are in place of that in "method.NAME.key=value".
[[noreturn]] void fail_unknown_name(toml::table& config, std::string_view kind,
                                    const std::string& name, const std::string& option) {
  std::vector<std::string> names;
  for (const toml::table* table : tables_of(config, kind))
    if (const std::string known = name_of(*table); !known.empty()) names.push_back(known);
  const std::string guess = closest_word(name, names);
  throw ConfigError("--set {}: no {} is called '{}' ({})", option, kind, name,
                    names.empty()   ? "none has a name"
                    : guess.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                                    : fmt::format("did you mean '{}'?", guess));
}

// "method.NAME.key=value": into one table of a section. A name may have dots and equals signs, a
// key has neither. False: not of this form.
bool assign_in_section(toml::table& config, std::string_view kind, const std::string& option) {
  if (!option.starts_with(fmt::format("{}.", kind))) return false;
  for (toml::table* table : tables_of(config, kind)) {
    const std::string before_key = fmt::format("{}.{}.", kind, name_of(*table));
    const std::size_t equals = option.find('=', before_key.size());
    if (!option.starts_with(before_key) || equals == std::string::npos) continue;
    const std::string key = option.substr(before_key.size(), equals - before_key.size());
    if (key.find('.') != std::string::npos) continue;
    assign(*table, key, option.substr(equals + 1), option);
    return true;
  }
  const std::string path = option.substr(0, option.find('='));
  const std::size_t first = path.find('.');
  const std::size_t last = path.rfind('.');
  if (first == last) return false;
  fail_unknown_name(config, kind, path.substr(first + 1, last - first - 1), option);
}

// "baseline.key": into that table. False: not of this form.
bool assign_in_table(toml::table& config, std::string_view name, const std::string& path,
                     std::string_view value, const std::string& option) {
  const std::string prefix = fmt::format("{}.", name);
  if (!path.starts_with(prefix)) return false;
  if (!single_section(config, name)) config.insert(name, toml::table());
  assign(*single_section(config, name), path.substr(prefix.size()), value, option);
  return true;
}

// "preview.NAME.key=value" into one preview, "preview.key=value" into all. False: not of this form.
bool assign_in_previews(toml::table& config, const std::string& path, std::string_view value,
                        const std::string& option) {
  const std::string prefix = "preview.";
  if (!path.starts_with(prefix)) return false;
  if (assign_in_section(config, "preview", option)) return true;
  if (!config.contains("preview")) config.insert("preview", toml::table());
  for (toml::table* table : tables_of(config, "preview"))
    assign(*table, path.substr(prefix.size()), value, option);
  return true;
}

// "fill.key": into one of the tables that direct a texture. False: not of this form.
bool assign_in_direction(toml::table& config, const std::string& path, std::string_view value,
                         const std::string& option) {
  bool assigned = false;
  for_each_direction(Direction(), [&]<class Entry>(const std::optional<Entry>&) {
    assigned = assigned || assign_in_table(config, Entry::section, path, value, option);
  });
  return assigned;
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

std::vector<toml::table*> tables_of(toml::table& config, std::string_view name) {
  toml::node* node = config.get(name);
  if (node && node->is_table()) return {node->as_table()};
  return section(config, name);
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
  else if (!assign_in_section(config, "method", option) &&
           !assign_in_section(config, "exemplar", option) &&
           !assign_in_section(config, "model", option) &&
           !assign_in_table(config, "baseline", key, value, option) &&
           !assign_in_table(config, "surface", key, value, option) &&
           !assign_in_previews(config, key, value, option) &&
           !assign_in_direction(config, key, value, option))
    assign_in_methods(config, key, value, option);
}

}  // namespace gramloom
