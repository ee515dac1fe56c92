#include "jobs/exemplar_folder.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/error.h"
#include "jobs/names.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& file) {
  constexpr auto extensions =
      std::to_array<std::string_view>({".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".tga",
                                       ".bmp", ".ppm", ".pgm", ".pnm", ".hdr", ".webp"});
  const std::string name = file.filename().string();
  return !name.starts_with('.') &&
         std::ranges::find(extensions, in_small_letters(file.extension().string())) !=
             extensions.end();
}

// "wall" and "height" of "wall_height"; "" twice of a name without such a line.
struct MapName {
  std::string texture, map;
};
MapName split(const std::string& stem) {
  const std::size_t line = stem.rfind('_');
  if (line == std::string::npos || line == 0) return {};
  return {stem.substr(0, line), stem.substr(line + 1)};
}

// Whether a picture of this name is a map of the other's texture.
bool is_map_of(const std::string& stem, const std::string& other) {
  const MapName name = split(stem);
  const auto kind = usual_map(name.map);
  if (!kind) return false;
  if (other == name.texture) return true;
  const MapName colours = split(other);
  return *kind != MapKind::colour && colours.texture == name.texture &&
         usual_map(colours.map) == MapKind::colour;
}

// All pictures there, maps too.
std::vector<fs::path> all_pictures(const fs::path& folder) {
  std::error_code failure;
  std::vector<fs::path> all;
  fs::directory_iterator entries(folder, failure);
  if (failure) throw Error("{}: {}", folder.string(), failure.message());
  for (const auto& entry : entries)
    if (is_picture(entry.path()) && entry.is_regular_file(failure)) all.push_back(entry.path());
  std::ranges::sort(all);
  return all;
}

}  // namespace

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::error_code failure;
  if (!fs::is_directory(folder, failure))
    throw Error("{}: there is no such folder", folder.string());
  const std::vector<fs::path> all = all_pictures(folder);
  std::vector<fs::path> pictures;
  std::ranges::copy_if(all, std::back_inserter(pictures), [&](const fs::path& file) {
    return std::ranges::none_of(all, [&](const fs::path& other) {
      return is_map_of(file.stem().string(), other.stem().string());
    });
  });
  return pictures;
}

NamedFiles<MapFile> maps_beside(const fs::path& picture) {
  NamedFiles<MapFile> maps;
  const fs::path folder = picture.has_parent_path() ? picture.parent_path() : fs::path(".");
  std::error_code failure;
  if (!fs::is_directory(folder, failure)) return maps;  // nor is the picture there
  for (const fs::path& file : all_pictures(folder)) {
    const std::string stem = file.stem().string();
    if (!is_map_of(stem, picture.stem().string())) continue;
    MapFile map;
    map.image = file;
    maps.emplace(in_small_letters(split(stem).map), map);
  }
  return maps;
}

}  // namespace gramloom
