#include "io/image_file.h"

#include "core/error.h"
#include "core/modules.h"
#include "io/pictures_module.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

void check_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error) throw Error("{}: cannot read: {}", path.string(), error.message());
  if (fs::is_directory(status)) throw Error("{}: cannot read: Is a directory", path.string());
  if (fs::is_regular_file(status) && fs::file_size(path, error) == 0)
    throw Error("{}: the file is empty", path.string());
}

}  // namespace

ImageFile read_image(const fs::path& path) {
  check_file(path);
  return open_module<PicturesModule>().read(path);
}

void write_image(const fs::path& path, const Image& image, const Encoding& encoding,
                 const Metadata& metadata) {
  if (image.empty()) throw Error("{}: an empty image cannot be written", path.string());
  open_module<PicturesModule>().write(path, image, encoding, metadata);
}

}  // namespace gramloom
