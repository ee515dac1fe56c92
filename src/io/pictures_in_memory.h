#pragma once

#include <filesystem>
#include <map>

#include "io/image_file.h"

namespace gramloom {

/// Pictures that have no file: who calls the library with some, and a config that names them, gives
/// them here. While one of these lives, its thread finds a picture under the name that the config
/// has, as if a file were there.
class PicturesInMemory {
 public:
  using Pictures = std::map<std::filesystem::path, ImageFile>;
  explicit PicturesInMemory(Pictures pictures);
  ~PicturesInMemory();
  PicturesInMemory(const PicturesInMemory&) = delete;
  PicturesInMemory& operator=(const PicturesInMemory&) = delete;

 private:
  Pictures pictures_;
  const Pictures* before_;  // that the thread had
};

/// The thread's picture of this name; of none, nullptr.
const ImageFile* picture_in_memory(const std::filesystem::path& name);

}  // namespace gramloom
