#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/progress.h"
#include "io/field_values.h"
#include "jobs/direction.h"

namespace gramloom {

/// What `fill` is asked: a [fill] in one line.
struct FillWork {
  std::filesystem::path picture;
  std::string mask;  // a file or "alpha"
  Tile seamless = Tile::none;
  int band = 0;
  std::vector<int> extend;
  int blend = FillEntry().blend;
  std::vector<std::filesystem::path> from;  // exemplars; none: the picture itself
  std::string method = "patchmatch";
  int seed = 1;
  std::filesystem::path output;
};

/// The config that does the same, with absolute paths.
std::string config_of(const FillWork& work);

/// Fills the picture and writes it, in its own pixel type where the file can hold that, with its
/// metadata and its colour profile; returns notes. Throws ConfigError for what the user must
/// change, Interrupted when `control` asks to stop, Error when it fails.
std::vector<std::string> fill_picture(const FillWork& work, const Control& control);

}  // namespace gramloom
