// Where the rest of the program enters the module that needs OpenImageIO.
#include "io/image_file.h"

#include "core/error.h"
#include "core/modules.h"
#include "io/image_algorithms.h"
#include "io/image_rows.h"
#include "io/pictures_in_memory.h"
#include "io/pictures_module.h"

namespace gramloom {

ImageFile read_image(const std::filesystem::path& path) {
  if (const ImageFile* picture = picture_in_memory(path)) return *picture;
  return open_module<PicturesModule>().read(path);
}

Size read_image_size(const std::filesystem::path& path) {
  if (const ImageFile* picture = picture_in_memory(path)) return picture->image.size();
  return open_module<PicturesModule>().read_size(path);
}

std::vector<std::string> write_image(const std::filesystem::path& path, const Image& image,
                                     const Encoding& encoding, const Metadata& metadata) {
  if (image.empty()) throw Error("{}: an empty image cannot be written", path.string());
  return open_module<PicturesModule>().write(path, image, encoding, metadata);
}

PixelType stored_type(const std::string& extension, PixelType type) {
  return open_module<PicturesModule>().stored_type(extension, type);
}

PixelDifference difference(const Image& a, const Image& b, double tolerance) {
  return open_module<PicturesModule>().difference(a, b, tolerance);
}

std::unique_ptr<ImageRows> open_image_rows(const std::filesystem::path& path, Size size,
                                           int channels, const Encoding& encoding,
                                           const Metadata& metadata) {
  return open_module<PicturesModule>().open_rows(path, size, channels, encoding, metadata);
}

std::string encoded_image(const std::string& extension, const Image& image,
                          const Encoding& encoding) {
  return open_module<PicturesModule>().encoded(extension, image, encoding);
}

std::vector<std::byte> stored_pixels(const Image& image, PixelType type) {
  return open_module<PicturesModule>().stored_pixels(image, type);
}

}  // namespace gramloom
