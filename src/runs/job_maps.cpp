#include "runs/job_maps.h"

#include <algorithm>
#include <filesystem>

#include "io/field_values.h"
#include "runs/map_names.h"

namespace gramloom {

namespace fs = std::filesystem;

std::string map_of_file(const std::string& job, const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  const std::string own = fs::path(job).filename().string() + "_";
  return stem.starts_with(own) ? stem.substr(own.size()) : "";
}

std::string label_of_file(const std::string& job, const std::filesystem::path& file) {
  const std::string map = map_of_file(job, file.filename().string());
  return map.empty() ? "picture" : map;
}

std::string material_map_of(const JobRecord& record, const std::string& map) {
  if (record.normals.contains(map)) return "normal";
  const Json& settings = record.settings;
  const bool is_height = settings.is_object() && settings.contains("surface") &&
                         settings["surface"].is_object() &&
                         settings["surface"].value("height", Json()) == map;
  return is_height ? "height" : material_map(map);
}

Tile tile_of(const Json& settings) {
  const std::string word = settings.is_object() ? settings.value("tile", "none") : "none";
  constexpr auto names = enum_names<Tile>;
  const auto found = std::ranges::find(names, word);
  return found == names.end() ? Tile::none : static_cast<Tile>(found - names.begin());
}

}  // namespace gramloom
