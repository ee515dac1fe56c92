#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "io/image_file.h"
#include "learnt/generator.h"

namespace gramloom {

/// The work of `gramloom generate`: a trained generator makes a picture of any size.
struct GenerateWork {
  GeneratorParams params;
  Size size{1024, 1024};
  Tile tile = Tile::none;
  int seed = 1;
  std::filesystem::path output;         // a map goes to NAME_<map> beside it
  std::optional<PixelType> pixel_type;  // none: 8 bits, and 16 of a map that is no colour
};

struct GeneratedFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes;  // "ground.png: …"
};

/// Makes the result some rows at a time and writes each as it is made, so that memory does not grow
/// with its height. Files that are there are replaced when the new ones are complete, but never one
/// that is read. Throws ConfigError for what the user must change, Error for a file that cannot be
/// read or written, Interrupted when the progress says stop.
GeneratedFiles generate_picture(const GenerateWork& work, const Control& control);

}  // namespace gramloom
