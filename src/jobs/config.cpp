#include "jobs/config.h"

#include <algorithm>
#include <set>

#include "io/text_file.h"
#include "io/toml_reader.h"
#include "jobs/exemplar_entries.h"
#include "jobs/method_reader.h"
#include "jobs/model_entries.h"
#include "jobs/names.h"
#include "jobs/overrides.h"
#include "jobs/read_direction.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// A method's name is a folder beside the files of its exemplar.
bool is_file_of_exemplar(const std::string& name) {
  return is_own_file(name, "exemplar") || ((in_small_letters(name).starts_with("exemplar_") ||
                                            in_small_letters(name).starts_with("target_")) &&
                                           fs::path(name).has_extension());
}

std::vector<MethodEntry> read_methods(toml::table& config) {
  std::vector<MethodEntry> methods;
  NamesInUse names;
  for (const toml::table* table : section(config, "method")) {
    MethodEntry method;
    method.method = read_method(*table);
    method.name = required_text(*table, "name");
    check_name(method.name, longest_file_name, key_region(*table, "name"));
    names.add(method.name, key_region(*table, "name"));
    if (is_file_of_exemplar(method.name)) fail_taken_name(method.name, key_region(*table, "name"));
    method.place = place(table->source());
    methods.push_back(std::move(method));
  }
  return methods;
}

// A table like [baseline] through its field list; without one, the defaults.
template <class Fields>
Fields read_section(toml::table& config, std::string_view name) {
  Fields fields;
  const toml::table* table = single_section(config, name);
  if (!table) return fields;
  check_keys(*table, key_names<Fields>());
  read_fields(fields, *table);
  return fields;
}

// The exemplar's map that has this name on a disk that does not tell capitals apart; "" for none.
std::string map_called(const ExemplarEntry& exemplar, const std::string& name) {
  for (const auto& [map, file] : exemplar.maps)
    if (in_small_letters(map) == in_small_letters(name)) return map;
  return "";
}

// Heights are guessed where there are none.
void check_guess(const Config& config, const toml::source_region& region) {
  bool any = false;
  for (const ExemplarEntry& exemplar : config.exemplars) {
    if (!height_among(exemplar.maps, config.surface).empty()) continue;
    any = true;
    for (const std::string name : {"height", "roughness"})
      if (const std::string map = map_called(exemplar, name); !map.empty() && map != name)
        fail(region, "the map '{}' of '{}' would have the file of the guessed '{}': rename it", map,
             exemplar.name, name);
  }
  const bool needed = std::ranges::any_of(
      config.methods, [](const MethodEntry& entry) { return needs_exemplar(entry.method); });
  if (!any || (!needed && config.models.empty()))
    fail(region, "'guess' has no effect: {}",
         needed ? "every exemplar has a height" : "no method here makes textures of an exemplar");
}

// Maps are made of a height, and nobody has two maps of one name.
void check_surface(const Config& config, toml::table& table) {
  if (!makes_any(config.surface)) return;
  const std::vector<std::string> asked = maps_asked(config.surface);
  const toml::source_region& region = key_region(table, "surface");
  if (config.surface.guess) check_guess(config, region);
  bool any_height = config.surface.guess;
  for (const MethodEntry& method : config.methods) any_height |= !needs_exemplar(method.method);
  for (const ExemplarEntry& exemplar : config.exemplars) {
    any_height |= !height_among(exemplar.maps, config.surface).empty();
    for (const std::string& name : asked)
      if (exemplar.maps.contains(name))
        fail(region, "the map '{}' is the exemplar's own, of '{}': leave one of the two out", name,
             exemplar.name);
  }
  if (!any_height)
    fail(region,
         "'surface' makes maps of heights: no exemplar has a map called '{}' (guess = true guesses "
         "heights from the colours)",
         config.surface.height);
}

// The file of a preview is not that of a map.
void check_preview_names(const Config& config) {
  for (const PreviewEntry& preview : config.previews)
    for (const ExemplarEntry& exemplar : config.exemplars)
      if (const std::string map = map_called(exemplar, label_of(preview)); !map.empty())
        throw ConfigError("{}: the map '{}' of '{}' would have the file of the {}: rename it",
                          preview.place, map, exemplar.name, title_of(preview));
}

void check_seeds(const Config& config, const toml::table& table) {
  const toml::source_region& region = key_region(table, "seeds");
  if (config.seeds.empty()) fail(region, "'seeds' is empty");
  const std::set<int> different(config.seeds.begin(), config.seeds.end());
  if (different.size() != config.seeds.size()) fail(region, "'seeds' has a seed twice");
}

// Coordinates are of pixels that are the exemplar's.
void check_coordinates(const Config& config) {
  if (!config.coordinates) return;
  for (const MethodEntry& entry : config.methods)
    if (const auto* quilting = std::get_if<QuiltingParams>(&entry.method);
        quilting && quilting->feather > 0)
      throw ConfigError(
          "{}: method '{}': feather = {} blends pixels, and there are no coordinates of blends: "
          "allowed with coordinates is 0",
          entry.place, entry.name, quilting->feather);
}

// What only shows when all is read.
void check_whole(const Config& config, const toml::table& table) {
  check_seeds(config, table);
  check_coordinates(config);
  if (config.methods.empty() && config.models.empty())
    throw ConfigError("{}: there is no [[method]], nor a [[model]] to train", config.file.string());
  for (const auto& method : config.methods)
    if (needs_exemplar(method.method) && config.exemplars.empty())
      throw ConfigError("{}: method '{}' needs an [[exemplar]]", method.place, method.name);
  for (const auto& method : config.methods)
    if (const std::string name = compared_with(method.method);
        !name.empty() && std::none_of(config.exemplars.begin(), config.exemplars.end(),
                                      [&](const auto& exemplar) { return exemplar.name == name; }))
      throw ConfigError("{}: method '{}': no exemplar is called '{}'", method.place, method.name,
                        name);
  const bool procedural =
      std::any_of(config.methods.begin(), config.methods.end(),
                  [](const auto& method) { return !needs_exemplar(method.method); });
  for (const auto& exemplar : config.exemplars)
    if (procedural && in_small_letters(exemplar.name) == procedural_folder)
      throw ConfigError("{}: the name '{}' is taken by methods without an exemplar", exemplar.place,
                        exemplar.name);
}

}  // namespace

Config parse_config(const std::string& text, const fs::path& file,
                    const std::vector<std::string>& overrides) {
  toml::table table = parse_toml(text, file.string());
  for (const auto& option : overrides) apply_override(table, option);
  std::vector<std::string> keys = config_keys();
  keys.insert(keys.end(), {"exemplar", "method", "model", "baseline", "surface", "preview"});
  for_each_direction(Direction(), [&]<class Entry>(const std::optional<Entry>&) {
    keys.emplace_back(Entry::section);
  });
  check_keys(table, keys);

  Config config;
  config.file = file;
  config.text = text;
  config.overrides = overrides;
  read_fields(config, table);
  config.exemplars = read_exemplars(table);
  config.methods = read_methods(table);
  config.models = read_models(table, config);
  config.direction = read_direction(table);
  follow_direction(config, table);
  config.baseline = read_section<BaselineLimits>(table, "baseline");
  config.surface = read_section<SurfaceParams>(table, "surface");
  config.previews = read_previews(table);
  check_preview_names(config);
  check_whole(config, table);
  check_surface(config, table);
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
