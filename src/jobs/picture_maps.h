#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "jobs/config.h"
#include "surface/maps.h"
#include "surface/photo.h"

namespace gramloom {

/// What the picture is that maps are made of: a height map, a normal map whose height is wanted
/// too, or a photograph of a material.
enum class MapSource { height, normal, photo };

/// The work of `gramloom maps`.
struct MapWork {
  std::filesystem::path picture;
  MapSource source = MapSource::height;
  MapParams maps;     // what is made of the height; `green` is also a normal map's that is read
  PhotoParams photo;  // how a photograph is taken
  Tile tile = Tile::none;
  FileFormat format = FileFormat::automatic;
  std::optional<PixelType> pixel_type;  // none: the picture's; guessed heights of 8 bits get 16
  std::filesystem::path output;         // folder of the maps; empty: the picture's
};

struct MadeMaps {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes;  // "wall_height.png: …": what to know of their values
  std::string config;              // of a photograph: the [[exemplar]] that has them
};

/// Reads the picture and writes its maps as NAME_normal.png and so on, where NAME is that of the
/// picture without "_height" or "_normal" at its end. A map replaces only one that this function
/// made, and never what is read. Throws ConfigError for what the user must change, Error for a
/// file that cannot be read or written.
MadeMaps make_maps(const MapWork& work);

}  // namespace gramloom
