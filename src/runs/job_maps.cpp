#include "runs/job_maps.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>

#include "io/field_values.h"

namespace gramloom {

namespace fs = std::filesystem;

std::string map_of_file(const std::string& job, const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  const std::string own = fs::path(job).filename().string() + "_";
  return stem.starts_with(own) ? stem.substr(own.size()) : "";
}

std::string material_map(const std::string& map) {
  const auto is = [&](std::initializer_list<std::string_view> words) {
    return std::ranges::find(words, std::string_view(map)) != words.end();
  };
  if (is({"normal", "normals", "nrm"})) return "normal";
  if (is({"height", "displacement", "disp", "bump"})) return "height";
  if (is({"roughness", "rough"})) return "roughness";
  if (is({"metalness", "metallic", "metal"})) return "metalness";
  if (is({"occlusion", "ao", "ambient_occlusion"})) return "occlusion";
  return "";
}

Tile tile_of(const Json& settings) {
  const std::string word = settings.is_object() ? settings.value("tile", "none") : "none";
  constexpr auto names = enum_names<Tile>;
  const auto found = std::ranges::find(names, word);
  return found == names.end() ? Tile::none : static_cast<Tile>(found - names.begin());
}

}  // namespace gramloom
