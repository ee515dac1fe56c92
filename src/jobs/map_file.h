#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/image.h"
#include "core/map_words.h"
#include "io/image_file.h"

namespace gramloom {

/// A map of an exemplar as the config names it: a file, or a table of these fields.
struct MapFile {
  std::filesystem::path image;
  std::optional<MapKind> kind;     // none: guessed
  std::optional<GreenAxis> green;  // likewise, of a normal map

  friend bool operator==(const MapFile&, const MapFile&) = default;

  static constexpr auto fields() {
    using M = MapFile;
    return std::tuple{
        Field{"image", &M::image, "the map's file"},
        Field{"kind", &M::kind, "what its values are; guessed from names if not set"},
        Field{"green", &M::green,
              "where a normal map's green points; up (OpenGL) if names don't say"},
    };
  }
};

/// What the values of a map called so are, where it is a usual name for one: "height", "normal",
/// "mask", "albedo".
std::optional<MapKind> usual_map(const std::string& name);

/// What the values of a map are, told by its name, else by its file's ("wall_normal.png",
/// "Bricks_NormalDX.png"), else by its values: three channels that are unit vectors nearly
/// everywhere are normals, other three are colours, and all else is scalars. The config's word
/// counts first.
MapKind kind_of_map(const std::string& map, const MapFile& file, const Image& values);

/// Where its green points: as the config says, else as its name or its file's does (DirectX,
/// OpenGL), else as a file of ours says itself, else up.
GreenAxis green_of_map(const std::string& map, const MapFile& file, const Metadata& metadata);

/// What a file of normals of ours says of its green.
Metadata green_metadata(GreenAxis green);

}  // namespace gramloom
