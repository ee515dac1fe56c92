#include "jobs/config.h"

#include <algorithm>
#include <set>

#include "io/text_file.h"
#include "io/toml_reader.h"
#include "jobs/exemplar_folder.h"
#include "jobs/method_reader.h"
#include "jobs/names.h"
#include "jobs/overrides.h"
#include "surface/preview.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// A method's name is a folder beside the files of its exemplar.
bool is_file_of_exemplar(const std::string& name) {
  return is_own_file(name, "exemplar") ||
         (in_small_letters(name).starts_with("exemplar_") && fs::path(name).has_extension());
}

// An exemplar's name is a folder beside the files of the run.
bool is_file_of_run(const std::string& name) {
  return is_own_file(name, "run") || is_own_file(name, "scores") || is_own_file(name, "index") ||
         is_own_file(name, "baseline");
}

[[noreturn]] void fail_taken(const std::string& name, const toml::source_region& region) {
  fail(region, "the name '{}' is taken by a file of the run's own: choose another", name);
}

void check_new_name(const std::string& name, NamesInUse& names, const toml::source_region& region) {
  check_name(name, longest_file_name, region);
  names.add(name, region);
}

void check_exemplar_name(const std::string& name, NamesInUse& names,
                         const toml::source_region& region) {
  check_new_name(name, names, region);
  if (is_file_of_run(name)) fail_taken(name, region);
}

void check_maps(const NamedFiles<MapFile>& maps, const toml::source_region& region) {
  NamesInUse names;
  for (const auto& [map, file] : maps) {
    check_name(map, longest_map_name, region);
    names.add(map, region);
    if (file.image.empty()) fail(region, "the map '{}' has no file", map);
  }
}

ExemplarEntry read_exemplar(const toml::table& table, NamesInUse& names) {
  ExemplarEntry exemplar;
  exemplar.name = required_text(table, "name");
  check_exemplar_name(exemplar.name, names, key_region(table, "name"));
  exemplar.place = place(table.source());
  required_text(table, "image");
  read_fields(exemplar, table);
  check_maps(exemplar.maps, key_region(table, "maps"));
  return exemplar;
}

// An exemplar for each picture in a folder, called like its file.
std::vector<ExemplarEntry> read_exemplar_folder(const toml::table& table, NamesInUse& names) {
  const toml::source_region& region = key_region(table, "folder");
  for (const char* key : {"image", "maps"})
    if (table.contains(key))
      fail(key_region(table, key), "'{}' is of one picture: leave it or 'folder' out", key);
  required_text(table, "name");  // for --set exemplar.NAME.folder=...
  const fs::path folder = required_folder(table, "folder");
  std::vector<fs::path> pictures;
  try {
    pictures = pictures_in(folder);
  } catch (const Error& error) {
    fail(region, "{}", error.what());
  }
  if (pictures.empty()) fail(region, "there is no picture in {}", folder.string());
  ExemplarEntry exemplar;
  exemplar.place = place(table.source());
  read_fields_if(exemplar, table, [](std::string_view key) { return key == "max_side"; });
  std::vector<ExemplarEntry> exemplars;
  for (const fs::path& picture : pictures) {
    exemplar.name = picture.stem().string();
    exemplar.image = picture;
    check_exemplar_name(exemplar.name, names, region);
    exemplars.push_back(exemplar);
  }
  return exemplars;
}

std::vector<ExemplarEntry> read_exemplars(toml::table& config) {
  std::vector<ExemplarEntry> exemplars;
  NamesInUse names;
  for (const toml::table* table : section(config, "exemplar")) {
    check_keys(*table, key_names<ExemplarEntry>({"name", "folder"}));
    if (table->contains("folder"))
      std::ranges::move(read_exemplar_folder(*table, names), std::back_inserter(exemplars));
    else
      exemplars.push_back(read_exemplar(*table, names));
  }
  return exemplars;
}

std::vector<MethodEntry> read_methods(toml::table& config) {
  std::vector<MethodEntry> methods;
  NamesInUse names;
  for (const toml::table* table : section(config, "method")) {
    MethodEntry method;
    method.method = read_method(*table);
    method.name = required_text(*table, "name");
    check_new_name(method.name, names, key_region(*table, "name"));
    if (is_file_of_exemplar(method.name)) fail_taken(method.name, key_region(*table, "name"));
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

// Maps are made of a height, and nobody has two maps of one name.
void check_surface(const Config& config, toml::table& table) {
  const std::vector<std::string> asked = maps_asked(config.surface);
  if (asked.empty()) return;
  const toml::source_region& region = key_region(table, "surface");
  bool any_height = false;
  for (const MethodEntry& method : config.methods) any_height |= !needs_exemplar(method.method);
  for (const ExemplarEntry& exemplar : config.exemplars) {
    any_height |= !height_among(exemplar.maps, config.surface).empty();
    for (const std::string& name : asked)
      if (exemplar.maps.contains(name))
        fail(region, "the map '{}' is the exemplar's own, of '{}': leave one of the two out", name,
             exemplar.name);
  }
  if (!any_height)
    fail(region, "'surface' makes maps of heights: no exemplar has a map called '{}'",
         config.surface.height);
}

// What a preview's fields cannot say alone; and its file is not that of a map.
void check_preview_section(const Config& config, const toml::source_region& region) {
  try {
    check_preview(*config.preview);
  } catch (const Error& error) {
    fail(region, "preview: {}", error.what());
  }
  for (const ExemplarEntry& exemplar : config.exemplars)
    if (exemplar.maps.contains("preview"))
      fail(region, "the map 'preview' of '{}' would have the file of the preview: rename it",
           exemplar.name);
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
  keys.insert(keys.end(), {"exemplar", "method", "baseline", "surface", "preview"});
  check_keys(table, keys);

  Config config;
  config.file = file;
  config.text = text;
  config.overrides = overrides;
  read_fields(config, table);
  config.exemplars = read_exemplars(table);
  config.methods = read_methods(table);
  config.baseline = read_section<BaselineLimits>(table, "baseline");
  config.surface = read_section<SurfaceParams>(table, "surface");
  if (single_section(table, "preview")) {
    config.preview = read_section<PreviewParams>(table, "preview");
    check_preview_section(config, key_region(table, "preview"));
  }
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
