#include <OpenImageIO/filesystem.h>

#include <algorithm>

#include "core/error.h"
#include "io/check_finite.h"
#include "io/image_file.h"
#include "io/image_format.h"
#include "io/json_text.h"
#include "io/pictures_module.h"
#include "io/quiet_stderr.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

std::string encode(OIIO::ImageOutput& output, const OIIO::ImageSpec& spec, const Image& image,
                   const std::string& extension) {
  const QuietStderr quiet;
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output.set_ioproxy(&memory) || !output.open("image" + extension, spec) ||
      !output.write_image(spec.format,
                          stored_values(spec, image.pixels.data(), image.height).data()) ||
      !output.close())
    throw Error("cannot be encoded: {}", output.geterror());
  return {bytes.begin(), bytes.end()};
}

/// Colours and alpha stay as they are; but other programs expect of each format the one or the
/// other.
void note_other_alpha(const std::string& extension, const Image& image, const Encoding& encoding,
                      std::vector<std::string>& notes) {
  const auto output = writer_for(extension);
  const Format& format = format_of(output.get(), extension);
  const int alpha = make_spec(format, image.size(), image.channels, encoding, {}).alpha_channel;
  if (alpha < 0 || format.name == "tiff" || encoding.premultiplied == (format.name == "openexr"))
    return;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (auto i = static_cast<std::size_t>(alpha); i < image.pixels.size(); i += channels)
    if (image.pixels[i] != 1) {
      notes.push_back(
          fmt::format("colours are {}multiplied by alpha, which is unusual in a {} file",
                      encoding.premultiplied ? "" : "not ", format.name));
      return;
    }
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
  const std::string extension = path.extension().string();
  std::vector<std::string> notes;
  const auto output = writer_for(extension);
  const Format& format = format_of(output.get(), extension);
  const PixelType stored = gramloom::stored_type(format, encoding.pixel_type);
  note_coarser_type(format, encoding.pixel_type, stored, notes);
  Clamped clamped;
  count_clamped(image.pixels.data(), image.pixels.size(), stored, clamped);
  note_clamped(clamped, stored, notes);
  Image held;
  if (stored == PixelType::half && clamped.beyond > 0) {
    held = image;
    clamp_to_half(held.pixels);
  }
  const OIIO::ImageSpec spec = make_spec(format, image.size(), image.channels, encoding, metadata);
  write_text(path, encode(*output, spec, held.empty() ? image : held, extension));
  return notes;
}

}  // namespace

std::vector<std::string> pictures::write(const fs::path& path, const Image& image,
                                         const Encoding& encoding, const Metadata& metadata) {
  try {
    check_finite(image);
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    const bool is_file = !fs::exists(status) || fs::is_regular_file(status);
    std::vector<std::string> notes =
        (is_file ? write_file : write_device)(path, image, encoding, metadata);
    note_other_alpha(path.extension().string(), image, encoding, notes);
    return notes;
  } catch (const std::bad_alloc&) {
    throw Error("{}: out of memory", path.string());
  } catch (const std::exception& error) {
    const std::string message = message_of(error);
    if (message.starts_with(path.string() + ":")) throw Error("{}", message);
    throw Error("{}: {}", path.string(), message);
  }
}

std::string pictures::encoded(const std::string& extension, const Image& image,
                              const Encoding& encoding) {
  check_finite(image);
  const auto output = writer_for(extension);
  const Format& format = format_of(output.get(), extension);
  return encode(*output, make_spec(format, image.size(), image.channels, encoding, {}), image,
                extension);
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
