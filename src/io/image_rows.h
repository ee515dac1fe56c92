#pragma once

#include <filesystem>
#include <memory>

#include "io/image_file.h"

namespace gramloom {

/// A picture that is written row by row, so that it need not fit into memory (of a JPEG, the file
/// has to). The file appears when finish() is called, complete, or not at all.
class ImageRows {
 public:
  virtual ~ImageRows() = default;
  /// The next `count` rows, interleaved floats. Throws Error with the path.
  virtual void write(const float* rows, int count) = 0;
  /// After the last row. Returns notes, as write_image() does. Throws Error with the path.
  virtual std::vector<std::string> finish() = 0;
};

/// Begins a file: as write_image() of a picture of this size, but for devices and pipes, which are
/// refused.
std::unique_ptr<ImageRows> open_image_rows(const std::filesystem::path& path, Size size,
                                           int channels, const Encoding& encoding,
                                           const Metadata& metadata = {});

}  // namespace gramloom
