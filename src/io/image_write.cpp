#include <OpenImageIO/filesystem.h>

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

/// In memory, so that one place (write_text) looks after full disks and half-written files.
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
void note_other_alpha(const Format& format, const OIIO::ImageSpec& spec, const Image& image,
                      bool premultiplied, std::vector<std::string>& notes) {
  if (spec.alpha_channel < 0 || format.name == "tiff" ||
      premultiplied == (format.name == "openexr"))
    return;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (auto i = static_cast<std::size_t>(spec.alpha_channel); i < image.pixels.size();
       i += channels)
    if (image.pixels[i] != 1) {
      notes.push_back(
          fmt::format("colours are {}multiplied by alpha, which is unusual in a {} file",
                      premultiplied ? "" : "not ", format.name));
      return;
    }
}

}  // namespace

std::vector<std::string> pictures::write(const fs::path& path, const Image& image,
                                         const Encoding& encoding, const Metadata& metadata) {
  const std::string extension = path.extension().string();
  std::vector<std::string> notes;
  std::string bytes;
  try {
    check_finite(image);
    const auto output = writer_for(extension);
    const Format& format = format_of(output.get(), extension);
    const OIIO::ImageSpec spec =
        make_spec(format, image.size(), image.channels, encoding, metadata);
    const PixelType stored = gramloom::stored_type(format, encoding.pixel_type);
    note_coarser_type(format, encoding.pixel_type, stored, notes);
    note_other_alpha(format, spec, image, encoding.premultiplied, notes);
    Clamped clamped;
    count_clamped(image.pixels.data(), image.pixels.size(), stored, clamped);
    note_clamped(clamped, stored, notes);
    if (clamped.beyond > 0 && stored == PixelType::half) {
      Image held = image;
      clamp_to_half(held.pixels);
      bytes = encode(*output, spec, held, extension);
    } else {
      bytes = encode(*output, spec, image, extension);
    }
  } catch (const std::bad_alloc&) {
    throw Error("{}: out of memory", path.string());
  } catch (const std::exception& error) {
    throw Error("{}: {}", path.string(), message_of(error));
  }
  write_text(path, bytes);
  return notes;
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
