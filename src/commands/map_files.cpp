#include "commands/map_files.h"

#include "core/error.h"

namespace gramloom {

NamedFiles<MapFile> named_maps(const std::vector<std::string>& words) {
  NamedFiles<MapFile> maps;
  for (const std::string& word : words) {
    const auto equals = word.find('=');
    const std::string name = word.substr(0, equals);
    if (equals == std::string::npos || name.empty() || equals + 1 == word.size() ||
        name.find('/') != std::string::npos)
      throw ConfigError("--map {}: needed is NAME=FILE, such as height=stones_height.png", word);
    MapFile file;
    file.image = word.substr(equals + 1);
    if (!maps.emplace(name, file).second)
      throw ConfigError("--map {}: there are two maps of this name", word);
  }
  return maps;
}

}  // namespace gramloom
