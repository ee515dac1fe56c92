#include <OpenImageIO/filesystem.h>

#include <algorithm>

#include "io/check_finite.h"
#include "io/image_encoder.h"
#include "io/pictures_module.h"
#include "io/text_file.h"
#include "io/with_path.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

std::string encode(const std::string& extension, const Image& image, const Encoding& encoding,
                   const Metadata& metadata, std::vector<std::string>& notes) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  ImageEncoder encoder(extension, image.size(), image.channels, encoding, metadata);
  encoder.open(memory);
  encoder.write(image.pixels.data(), image.height);
  encoder.close();
  notes = encoder.notes();
  return {bytes.begin(), bytes.end()};
}

// By some rows at once, enough for the threads of a library: of a large picture, the values as the
// file stores them and the file itself would be in memory beside it.
std::vector<std::string> write_file(const fs::path& path, const Image& image,
                                    const Encoding& encoding, const Metadata& metadata) {
  const auto file = pictures::open_rows(path, image.size(), image.channels, encoding, metadata);
  constexpr int values_at_once = 1 << 22, least = 64;
  const int at_once =
      std::max(least, values_at_once / image.width / image.channels / least * least);
  for (int y = 0; y < image.height; y += at_once)
    file->write(image.at(0, y), std::min(at_once, image.height - y));
  return file->finish();
}

// A device cannot be written at an earlier place, as writers of some formats do: so the file is
// made in memory first.
std::vector<std::string> write_device(const fs::path& path, const Image& image,
                                      const Encoding& encoding, const Metadata& metadata) {
  std::vector<std::string> notes;
  write_text(path, encode(path.extension().string(), image, encoding, metadata, notes));
  return notes;
}

}  // namespace

std::vector<std::string> pictures::write(const fs::path& path, const Image& image,
                                         const Encoding& encoding, const Metadata& metadata) {
  return with_path(path, [&] {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    const bool is_file = !fs::exists(status) || fs::is_regular_file(status);
    return (is_file ? write_file : write_device)(path, image, encoding, metadata);
  });
}

std::string pictures::encoded(const std::string& extension, const Image& image,
                              const Encoding& encoding) {
  std::vector<std::string> ignored;
  return encode(extension, image, encoding, {}, ignored);
}

std::vector<std::byte> pictures::stored_pixels(const Image& image, PixelType type) {
  check_finite(image);
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, oiio_type(type));
  if (type != PixelType::half) return stored_values(spec, image.pixels.data(), image.height);
  std::vector<float> held = image.pixels;
  clamp_to_half(held);
  return stored_values(spec, held.data(), image.height);
}

PixelType pictures::stored_type(const std::string& extension, PixelType type) {
  const auto output = writer_for(extension);
  return gramloom::stored_type(format_of(output.get(), extension), type);
}

}  // namespace gramloom
