#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "io/field_values.h"
#include "io/image_file.h"
#include "jobs/map_file.h"
#include "surface/tiling.h"

namespace gramloom {

/// The work of `gramloom tile`: one small picture, with its maps, becomes one of any size by
/// stochastic tiling (surface/tiling.h).
struct TileWork {
  std::filesystem::path picture;
  NamedFiles<MapFile> maps;
  std::optional<int> max_side;  // the picture is scaled down to this first
  Size size{4096, 4096};
  Tile tile = Tile::none;  // edges of the result that meet
  TilingParams params;
  std::uint64_t seed = 1;
  std::filesystem::path output;         // a map goes to NAME_<map> beside it
  std::optional<PixelType> pixel_type;  // none: the picture's
};

struct TiledFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes;  // "floor.png: …"
};

/// Makes the result a few rows at a time and writes each as it is made, so that memory does not
/// grow with its size. Files that are there are replaced when the new ones are complete, but never
/// one that is read. Throws ConfigError for what the user must change, Error for a file that cannot
/// be read or written, Interrupted when the progress says stop.
TiledFiles tile_picture(const TileWork& work, const Control& control);

}  // namespace gramloom
