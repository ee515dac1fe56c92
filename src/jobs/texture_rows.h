#pragma once

#include <memory>

#include "io/image_rows.h"
#include "jobs/results.h"

namespace gramloom {

/// The files of a texture and its maps as write_texture() has them, written row by row.
class TextureRows {
 public:
  TextureRows(std::filesystem::path folder, std::string name, Size size,
              const OutputFormats& formats, const Json& settings, const Metadata& picture);
  /// The next rows of the texture and of all its maps.
  void write(const Texture& rows);
  /// After the last ones: only now the files are there.
  WrittenTexture finish();

 private:
  struct File {
    std::string name;
    OutputFormat format;
    std::unique_ptr<ImageRows> rows;
  };
  void open(const Texture& first);

  std::filesystem::path folder_;
  std::string name_;
  Size size_;
  OutputFormats formats_;
  Json settings_;
  Metadata picture_;
  std::map<std::string, File> files_;  // by the map, the picture as ""
};

}  // namespace gramloom
