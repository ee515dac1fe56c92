#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "jobs/config.h"

namespace gramloom {

/// What `make` is asked: a config of one job in one line. Its defaults are for a first picture: the
/// method whose pictures are the best, at a size and with settings that take it about ten seconds.
struct MakeWork {
  std::vector<std::string> exemplars;  // pictures of one material; or a procedural texture's name
  NamedFiles<MapFile> maps;            // of the one exemplar
  bool finds_maps = true;              // where none are named: those beside it (exemplar_folder.h)
  std::optional<int> max_side;         // none: 1024, or the longer side of the result
  Size size{512, 512};
  Tile tile = Tile::both;
  std::string kind;              // "": neural, or procedural for such a name
  std::optional<Preset> preset;  // none: fast
  std::vector<std::string> set;  // "key=value", parameters of the method
  int seed = 1;
  std::filesystem::path output;
};

/// The config that does the same, with absolute paths: its one texture has the same bytes.
std::string config_of(const MakeWork& work);

/// Makes the texture and writes it, and its maps beside it. Throws ConfigError for what the user
/// must change, Interrupted when `control` asks to stop, Error when it fails.
struct MadeFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes;
};
MadeFiles make_texture(const MakeWork& work, const Control& control);

}  // namespace gramloom
