#include "jobs/exemplar_entries.h"

#include <algorithm>

#include "io/toml_reader.h"
#include "jobs/exemplar_folder.h"
#include "jobs/names.h"
#include "jobs/overrides.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

bool is_file_of_run(const std::string& name) {
  return is_own_file(name, "run") || is_own_file(name, "scores") || is_own_file(name, "index") ||
         is_own_file(name, "baseline");
}

void check_new_exemplar(const std::string& name, NamesInUse& names,
                        const toml::source_region& region) {
  check_exemplar_name(name, region);
  names.add(name, region);
}

// What the pictures of an exemplar have of their own: not said once for several.
void check_alone(const toml::table& table, std::string_view key, const std::string& of_several) {
  if (!table.contains(key)) return;
  fail(key_region(table, key), "'{}' is of one picture: {}", key, of_several);
}

void check_picture_keys(const ExemplarPicture& picture, const toml::table& table) {
  check_maps(picture.maps, key_region(table, "maps"));
  check_mask(picture.mask, key_region(table, "mask"));
}

std::vector<fs::path> pictures_of_folder(const fs::path& folder,
                                         const toml::source_region& region) {
  std::vector<fs::path> pictures;
  try {
    pictures = pictures_in(folder);
  } catch (const Error& error) {
    fail(region, "{}", error.what());
  }
  if (pictures.empty()) fail(region, "there is no picture in {}", folder.string());
  return pictures;
}

// An entry of `images`: a file, a folder of some, or a table.
std::vector<ExemplarPicture> read_pictures(const toml::node& node) {
  ExemplarPicture picture;
  if (const toml::table* table = node.as_table()) {
    check_keys(*table, key_names<ExemplarPicture>());
    required_text(*table, "image");
    read_fields(picture, *table);
    check_picture_keys(picture, *table);
    return {picture};
  }
  picture.image = read_file_or_folder(node, "images", allowed_entry<ExemplarPicture>());
  std::error_code ignored;
  if (!fs::is_directory(picture.image, ignored)) return {picture};
  std::vector<ExemplarPicture> pictures;
  for (const fs::path& file : pictures_of_folder(picture.image, node.source()))
    pictures.push_back({file, {}, {}, {}});
  return pictures;
}

void read_images(ExemplarEntry& exemplar, const toml::table& table) {
  for (const char* key : {"image", "maps", "mask", "guide"})
    check_alone(table, key, "put it into the entry of 'images' that it belongs to");
  const toml::node& node = *table.get("images");
  const toml::source_region& region = key_region(table, "images");
  std::vector<ExemplarPicture> pictures;
  if (const toml::array* list = node.as_array()) {
    for (const toml::node& entry : *list)
      std::ranges::move(read_pictures(entry), std::back_inserter(pictures));
  } else {
    pictures = read_pictures(node);
  }
  if (pictures.empty()) fail(region, "'images' is empty");
  static_cast<ExemplarPicture&>(exemplar) = std::move(pictures.front());
  exemplar.more.assign(pictures.begin() + 1, pictures.end());
}

ExemplarEntry read_exemplar(const toml::table& table, NamesInUse& names) {
  ExemplarEntry exemplar;
  exemplar.name = required_text(table, "name");
  check_new_exemplar(exemplar.name, names, key_region(table, "name"));
  exemplar.place = place(table.source());
  if (table.contains("images")) {
    read_images(exemplar, table);
    read_fields_if(exemplar, table, [](std::string_view key) { return key == "max_side"; });
    return exemplar;
  }
  required_text(table, "image");
  read_fields(exemplar, table);
  check_picture_keys(exemplar, table);
  return exemplar;
}

// An exemplar for each picture in a folder, called like its file.
std::vector<ExemplarEntry> read_exemplar_folder(const toml::table& table, NamesInUse& names) {
  const toml::source_region& region = key_region(table, "folder");
  for (const char* key : {"image", "images", "maps", "mask", "guide"})
    check_alone(table, key, "leave it or 'folder' out");
  required_text(table, "name");  // for --set exemplar.NAME.folder=...
  ExemplarEntry exemplar;
  exemplar.place = place(table.source());
  read_fields_if(exemplar, table, [](std::string_view key) { return key == "max_side"; });
  std::vector<ExemplarEntry> exemplars;
  for (const fs::path& picture : pictures_of_folder(required_folder(table, "folder"), region)) {
    exemplar.name = picture.stem().string();
    exemplar.image = picture;
    check_new_exemplar(exemplar.name, names, region);
    exemplars.push_back(exemplar);
  }
  return exemplars;
}

// Files of the exemplar's folder that are no map's.
bool is_taken(const std::string& map) {
  const std::string name = in_small_letters(map);
  return name == "usable" || name == "guide" || name.starts_with("picture");
}

}  // namespace

void fail_taken_name(const std::string& name, const toml::source_region& region) {
  fail(region, "the name '{}' is taken by a file of the run's own: choose another", name);
}

void check_exemplar_name(const std::string& name, const toml::source_region& region) {
  check_name(name, longest_file_name, region);
  if (is_file_of_run(name)) fail_taken_name(name, region);
}

void check_maps(const NamedFiles<MapFile>& maps, const toml::source_region& region) {
  NamesInUse names;
  for (const auto& [map, file] : maps) {
    check_name(map, longest_map_name, region);
    if (is_taken(map)) fail_taken_name(map, region);
    names.add(map, region);
    if (file.image.empty()) fail(region, "the map '{}' has no file", map);
  }
}

bool is_alpha(const FileOrName& mask) { return mask == fs::path("alpha"); }

void check_mask(const FileOrName& mask, const toml::source_region& region) {
  if (mask.is_name() && !is_alpha(mask))
    fail(region, "mask = \"{}\": allowed are a file with its extension, and alpha", mask.string());
}

std::vector<ExemplarEntry> read_exemplars(toml::table& config) {
  std::vector<ExemplarEntry> exemplars;
  NamesInUse names;
  for (const toml::table* table : section(config, "exemplar")) {
    check_keys(*table, key_names<ExemplarEntry>({"name", "images", "folder"}));
    if (table->contains("folder"))
      std::ranges::move(read_exemplar_folder(*table, names), std::back_inserter(exemplars));
    else
      exemplars.push_back(read_exemplar(*table, names));
  }
  return exemplars;
}

std::vector<ExemplarPicture> pictures_of(const ExemplarEntry& exemplar) {
  std::vector<ExemplarPicture> pictures{exemplar};
  pictures.insert(pictures.end(), exemplar.more.begin(), exemplar.more.end());
  return pictures;
}

}  // namespace gramloom
