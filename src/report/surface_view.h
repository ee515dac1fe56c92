#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/map_words.h"

namespace gramloom {

/// What the page shows on a ball or as a wall: files relative to the run's folder, by what they are
/// ("colour", which must be there, "normal", "height", "occlusion", "roughness", "metalness").
struct SurfaceView {
  std::map<std::string, std::string> files;
  double white = 1;                 // of the colours (report/preview.h)
  double strength = 8;              // pixels that a height of 1 stands
  GreenAxis green = GreenAxis::up;  // of the normals
  Tile tile = Tile::none;
};

/// The path, relative to `folder`, of a script that hands the page copies of these files: `name`
/// + ".view.js" in folder/page. Browsers let a page on disk load scripts, but not look into picture
/// files. Sides are at most 512 pixels, colours then JPEG; small files are copied byte for byte. A
/// height has 16 bits, in red and green, and its own range is 0 to 1, `strength` with it. The
/// script is made when it is missing, older than a file, or of another tile, green or other maps.
/// Throws Error.
std::string surface_view_file(const std::filesystem::path& folder, const std::string& name,
                              const SurfaceView& view);

}  // namespace gramloom
