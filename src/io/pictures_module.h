#pragma once

#include <filesystem>

#include "io/image_file.h"

namespace gramloom {

/// What of io/ needs OpenImageIO: read_image() and write_image() once it is known that there is
/// something to read or write (core/modules.h).
struct PicturesModule {
  static constexpr std::string_view name = "pictures";
  ImageFile (*read)(const std::filesystem::path& path);
  void (*write)(const std::filesystem::path& path, const Image& image, const Encoding& encoding,
                const Metadata& metadata);
};

namespace pictures {
ImageFile read(const std::filesystem::path& path);
void write(const std::filesystem::path& path, const Image& image, const Encoding& encoding,
           const Metadata& metadata);
}  // namespace pictures

}  // namespace gramloom
