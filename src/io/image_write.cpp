#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string_view>

#include "core/error.h"
#include "io/check_finite.h"
#include "io/image_file.h"
#include "io/image_record.h"
#include "io/json_text.h"
#include "io/pictures_module.h"
#include "io/quiet_stderr.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

/// What a format can hold. We write only those that keep alpha as it is, and report what they
/// cannot do: of the others, OpenImageIO drops channels or multiplies colours by alpha without a
/// word.
struct Format {
  std::string_view name;                 // OpenImageIO's
  std::string_view channels;             // the counts it holds; "" for any
  std::array<PixelType, 4> stored_as{};  // for each PixelType
};

constexpr PixelType u8 = PixelType::uint8, u16 = PixelType::uint16, f16 = PixelType::half,
                    f32 = PixelType::float32;
constexpr auto formats = std::to_array<Format>({
    {"png", "1234", {u8, u16, u16, u16}},
    {"jpeg", "13", {u8, u8, u8, u8}},
    // Half floats in TIFF are an extension that few programs read.
    {"tiff", "", {u8, u16, f32, f32}},
    {"openexr", "", {f16, f32, f16, f32}},
    {"targa", "134", {u8, u8, u8, u8}},
    {"bmp", "134", {u8, u8, u8, u8}},
    {"pnm", "13", {u8, u8, u8, u8}},
    {"hdr", "3", {f32, f32, f32, f32}},
});

OIIO::TypeDesc oiio_type(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return OIIO::TypeDesc::UINT8;
    case PixelType::uint16:
      return OIIO::TypeDesc::UINT16;
    case PixelType::half:
      return OIIO::TypeDesc::HALF;
    case PixelType::float32:
      break;
  }
  return OIIO::TypeDesc::FLOAT;
}

/// OpenImageIO sees the extension alone: in a name, '?' would mean something to it.
std::unique_ptr<OIIO::ImageOutput> writer_for(const std::string& extension) {
  const bool plain = extension.find_first_of("?/") == std::string::npos;
  auto writer = plain ? OIIO::ImageOutput::create("image" + extension) : nullptr;
  if (!writer) OIIO::geterror();  // or OpenImageIO prints it when the process ends
  return writer;
}

const Format& format_of(const OIIO::ImageOutput* output, const std::string& extension) {
  const auto found = std::find_if(formats.begin(), formats.end(), [&](const Format& format) {
    return output && format.name == output->format_name();
  });
  if (found == formats.end())
    throw Error(
        "no image format that can be written has the extension '{}' (use .png, .tif or .exr)",
        extension);
  return *found;
}

void check_fits(const Format& format, const Image& image) {
  if (!format.channels.empty() &&
      (image.channels > 9 ||
       format.channels.find(static_cast<char>('0' + image.channels)) == std::string::npos))
    throw Error("a {} file cannot hold {} channel{}; .tif and .exr hold any number", format.name,
                image.channels, image.channels == 1 ? "" : "s");
  // Beyond these, libjpeg ends the whole process.
  if (format.name == "jpeg" && std::max(image.width, image.height) > longest_side_of_jpeg)
    throw Error("a jpeg file cannot hold {}×{} pixels; a side has at most {}", image.width,
                image.height, longest_side_of_jpeg);
}

/// Names, colour space and metadata as the text that every format keeps.
std::string describe(const Format& format, const ImageRecord& record) {
  std::string text = to_description(record);
  constexpr std::size_t jpeg_limit =
      60'000;  // a JPEG segment has 64 kB; again, libjpeg would end us
  if (format.name == "jpeg" && text.size() > jpeg_limit)
    throw Error("{} bytes of metadata are too many for a jpeg file", text.size());
  return text;
}

std::vector<std::string> channel_names(const Image& image, const Encoding& encoding) {
  const auto count = static_cast<std::size_t>(image.channels);
  if (encoding.channel_names.size() == count) {
    const std::set<std::string> different(encoding.channel_names.begin(),
                                          encoding.channel_names.end());
    if (different.size() != count || different.contains(""))
      throw Error("two channels have the same name, or one has none");
    return encoding.channel_names;
  }
  if (count == 1) return {"Y"};
  if (count == 2) return {"Y", "A"};
  std::vector<std::string> names{"R", "G", "B", "A"};
  for (std::size_t c = 4; c < count; ++c) names.push_back(fmt::format("channel{}", c));
  names.resize(count);
  return names;
}

OIIO::ImageSpec make_spec(const Format& format, const Image& image, const Encoding& encoding,
                          const Metadata& metadata) {
  const auto type = format.stored_as[static_cast<std::size_t>(encoding.pixel_type)];
  OIIO::ImageSpec spec(image.width, image.height, image.channels, oiio_type(type));
  spec.channelnames = channel_names(image, encoding);
  const auto alpha = std::find(spec.channelnames.begin(), spec.channelnames.end(), "A");
  spec.alpha_channel =
      alpha == spec.channelnames.end() ? -1 : static_cast<int>(alpha - spec.channelnames.begin());
  // Or OpenImageIO divides colours by alpha; a TIFF says which of the two it has.
  if (format.name != "tiff" || !encoding.premultiplied) spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!encoding.colour_space.empty()) spec.attribute("oiio:ColorSpace", encoding.colour_space);
  spec.attribute("ImageDescription", describe(format, {spec.channelnames, encoding.colour_space,
                                                       metadata, encoding.premultiplied}));
  // An EXIF part in a TIFF needs to read what is already written, which memory here does not allow.
  spec.attribute("tiff:write_exif", 0);
  spec.attribute("DateTime", "");  // or OpenImageIO writes the time of day into TIFF and EXR
  if (format.name == "jpeg") {
    spec.attribute("Compression", "jpeg:98");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  return spec;
}

/// The values as the file holds them. Of floats OpenImageIO would convert one row after the other,
/// each with all of its threads, and wait; and 2.5 turns a PNM of floats upside down, whatever type
/// the file has.
std::vector<std::byte> stored_values(const OIIO::ImageSpec& spec, const Image& image) {
  std::vector<std::byte> values(spec.image_bytes());
  OIIO::convert_image(image.channels, image.width, image.height, 1, image.pixels.data(),
                      OIIO::TypeDesc::FLOAT, OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride,
                      values.data(), spec.format, OIIO::AutoStride, OIIO::AutoStride,
                      OIIO::AutoStride);
  return values;
}

/// In memory, so that one place (write_text) looks after full disks and half-written files.
std::string encode(OIIO::ImageOutput& output, const OIIO::ImageSpec& spec, const Image& image,
                   const std::string& extension) {
  const QuietStderr quiet;
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output.set_ioproxy(&memory) || !output.open("image" + extension, spec) ||
      !output.write_image(spec.format, stored_values(spec, image).data()) || !output.close())
    throw Error("cannot be encoded: {}", output.geterror());
  return {bytes.begin(), bytes.end()};
}

// --- what the file has less of than the image ---------------------------------------------------

/// The values that a type can hold, and by how much one may lie beyond and still only be rounded.
struct Limits {
  float low, high, slack;
};
Limits limits_of(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return {0, 1, 0.5f / 255};
    case PixelType::uint16:
      return {0, 1, 0.5f / 65535};
    case PixelType::half:
      return {-65504, 65504, 0};
    case PixelType::float32:
      break;
  }
  return {std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max(), 0};
}

/// Whether values lie beyond what the type holds; then a note says so.
bool note_clamped(const Image& image, PixelType type, std::vector<std::string>& notes) {
  const Limits limits = limits_of(type);
  std::size_t beyond = 0;
  float least = 0, most = 0;
  for (const float value : image.pixels) {
    if (value < limits.low - limits.slack || value > limits.high + limits.slack) ++beyond;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  if (beyond > 0)
    notes.push_back(fmt::format(
        "{:.3g} % of the values, which reach from {:.4g} to {:.4g}, were clamped to {:g} to {:g}",
        100.0 * static_cast<double>(beyond) / static_cast<double>(image.pixels.size()), least, most,
        limits.low, limits.high));
  return beyond > 0;
}

/// OpenImageIO clamps for integers, and makes infinity of what half cannot hold.
Image clamp_to_half(Image image) {
  const Limits limits = limits_of(PixelType::half);
  for (float& value : image.pixels) value = std::clamp(value, limits.low, limits.high);
  return image;
}

void note_coarser_type(const Format& format, PixelType wanted, PixelType stored,
                       std::vector<std::string>& notes) {
  const auto bits = [](PixelType type) {
    return std::array{8, 16, 16, 32}[static_cast<std::size_t>(type)];
  };
  if (bits(stored) < bits(wanted))
    notes.push_back(fmt::format("{} became {}, the best that a {} file has", to_word(wanted),
                                to_word(stored), format.name));
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
    check_fits(format, image);
    const OIIO::ImageSpec spec = make_spec(format, image, encoding, metadata);
    const PixelType stored = format.stored_as[static_cast<std::size_t>(encoding.pixel_type)];
    note_coarser_type(format, encoding.pixel_type, stored, notes);
    note_other_alpha(format, spec, image, encoding.premultiplied, notes);
    const bool clamped = note_clamped(image, stored, notes);
    bytes = clamped && stored == PixelType::half
                ? encode(*output, spec, clamp_to_half(image), extension)
                : encode(*output, spec, image, extension);
  } catch (const std::bad_alloc&) {
    throw Error("{}: out of memory", path.string());
  } catch (const std::exception& error) {
    throw Error("{}: {}", path.string(), message_of(error));
  }
  write_text(path, bytes);
  return notes;
}

PixelType pictures::stored_type(const std::string& extension, PixelType type) {
  const auto output = writer_for(extension);
  return format_of(output.get(), extension).stored_as[static_cast<std::size_t>(type)];
}

}  // namespace gramloom
