#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/image_algorithms.h"
#include "io/image_encode.h"
#include "io/image_file.h"
#include "io/image_rows.h"

namespace gramloom {

/// What of io/ needs OpenImageIO (core/modules.h): the functions of these names in image_file.h,
/// image_rows.h, image_encode.h and image_algorithms.h.
struct PicturesModule {
  static constexpr std::string_view name = "pictures";
  ImageFile (*read)(const std::filesystem::path& path);
  Size (*read_size)(const std::filesystem::path& path);
  std::vector<std::string> (*write)(const std::filesystem::path& path, const Image& image,
                                    const Encoding& encoding, const Metadata& metadata);
  PixelType (*stored_type)(const std::string& extension, PixelType type);
  PixelDifference (*difference)(const Image& a, const Image& b, double tolerance);
  std::unique_ptr<ImageRows> (*open_rows)(const std::filesystem::path& path, Size size,
                                          int channels, const Encoding& encoding,
                                          const Metadata& metadata);
  std::string (*encoded)(const std::string& extension, const Image& image,
                         const Encoding& encoding);
  std::vector<std::byte> (*stored_pixels)(const Image& image, PixelType type);
};

namespace pictures {
ImageFile read(const std::filesystem::path& path);
Size read_size(const std::filesystem::path& path);
std::vector<std::string> write(const std::filesystem::path& path, const Image& image,
                               const Encoding& encoding, const Metadata& metadata);
PixelType stored_type(const std::string& extension, PixelType type);
PixelDifference difference(const Image& a, const Image& b, double tolerance);
std::string encoded(const std::string& extension, const Image& image, const Encoding& encoding);
std::vector<std::byte> stored_pixels(const Image& image, PixelType type);
std::unique_ptr<ImageRows> open_rows(const std::filesystem::path& path, Size size, int channels,
                                     const Encoding& encoding, const Metadata& metadata);

/// The picture turned and mirrored as the EXIF orientation (1 to 8; others change nothing) says
/// that it is to be seen.
Image turn(Image image, int orientation);
}  // namespace pictures

}  // namespace gramloom
