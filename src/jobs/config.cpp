#include "jobs/config.h"

#include <algorithm>
#include <set>

#include "io/text_file.h"
#include "io/toml_reader.h"
#include "jobs/method_reader.h"
#include "jobs/overrides.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_name = 100;

// A name becomes part of a path, on any file system.
void check_name(const std::string& name, const toml::source_region& region) {
  if (name.empty()) fail(region, "a name is empty");
  const bool unfit = std::any_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 32 ||
           std::string_view("/\\:*?\"<>|").find(c) != std::string_view::npos;
  });
  if (unfit || name.front() == '.' || name.front() == ' ' || name.back() == ' ')
    fail(region, "name '{}' is not fit for a file name", name);
  if (name.size() > longest_name)
    fail(region, "name is {} characters long, allowed are {}", name.size(), longest_name);
}

std::string read_name(const toml::table& table, std::set<std::string>& taken) {
  const std::string name = required_text(table, "name");
  const toml::source_region& region = key_region(table, "name");
  check_name(name, region);
  if (!taken.insert(name).second) fail(region, "name '{}' is there twice", name);
  return name;
}

std::vector<ExemplarEntry> read_exemplars(toml::table& config) {
  std::vector<ExemplarEntry> exemplars;
  std::set<std::string> names;
  for (const toml::table* table : section(config, "exemplar")) {
    check_keys(*table, key_names<ExemplarEntry>({"name"}));
    ExemplarEntry exemplar;
    exemplar.name = read_name(*table, names);
    exemplar.place = place(table->source());
    required_text(*table, "image");
    read_fields(exemplar, *table);
    for (const auto& [map, file] : exemplar.maps) {
      const toml::source_region& region = key_region(*table, "maps");
      check_name(map, region);
      if (file.empty()) fail(region, "the map '{}' has no file", map);
    }
    exemplars.push_back(std::move(exemplar));
  }
  return exemplars;
}

std::vector<MethodEntry> read_methods(toml::table& config) {
  std::vector<MethodEntry> methods;
  std::set<std::string> names;
  for (const toml::table* table : section(config, "method")) {
    MethodEntry method;
    method.method = read_method(*table);
    method.name = read_name(*table, names);
    method.place = place(table->source());
    methods.push_back(std::move(method));
  }
  return methods;
}

// The [baseline] table, where there is one.
BaselineLimits read_limits(toml::table& config) {
  BaselineLimits limits;
  const toml::table* table = single_section(config, "baseline");
  if (!table) return limits;
  check_keys(*table, key_names<BaselineLimits>());
  read_fields(limits, *table);
  return limits;
}

void check_seeds(const Config& config, const toml::table& table) {
  const toml::source_region& region = key_region(table, "seeds");
  if (config.seeds.empty()) fail(region, "'seeds' is empty");
  const std::set<int> different(config.seeds.begin(), config.seeds.end());
  if (different.size() != config.seeds.size()) fail(region, "'seeds' has a seed twice");
}

// What only shows when all is read.
void check_whole(const Config& config, const toml::table& table) {
  check_seeds(config, table);
  if (config.methods.empty()) throw ConfigError("{}: there is no [[method]]", config.file.string());
  for (const auto& method : config.methods)
    if (needs_exemplar(method.method) && config.exemplars.empty())
      throw ConfigError("{}: method '{}' needs an [[exemplar]]", method.place, method.name);
  const bool procedural =
      std::any_of(config.methods.begin(), config.methods.end(),
                  [](const auto& method) { return !needs_exemplar(method.method); });
  for (const auto& exemplar : config.exemplars)
    if (procedural && exemplar.name == procedural_folder)
      throw ConfigError("{}: the name '{}' is taken by methods without an exemplar", exemplar.place,
                        exemplar.name);
}

}  // namespace

Config parse_config(const std::string& text, const fs::path& file,
                    const std::vector<std::string>& overrides) {
  toml::table table = parse_toml(text, file.string());
  for (const auto& option : overrides) apply_override(table, option);
  std::vector<std::string> keys = config_keys();
  keys.insert(keys.end(), {"exemplar", "method", "baseline"});
  check_keys(table, keys);

  Config config;
  config.file = file;
  config.text = text;
  config.overrides = overrides;
  read_fields(config, table);
  config.exemplars = read_exemplars(table);
  config.methods = read_methods(table);
  config.baseline = read_limits(table);
  check_whole(config, table);
  return config;
}

Config read_config(const fs::path& file, const std::vector<std::string>& overrides) {
  std::string text;
  try {
    text = read_text(file);
  } catch (const Error& error) {
    throw ConfigError("{}", error.what());
  }
  return parse_config(text, file, overrides);
}

}  // namespace gramloom
