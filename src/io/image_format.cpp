#include "io/image_format.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>

#include "core/error.h"
#include "io/image_record.h"

namespace gramloom {

namespace {

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

void check_fits(const Format& format, Size size, int channels) {
  if (!format.channels.empty() && (channels > 9 || format.channels.find(static_cast<char>(
                                                       '0' + channels)) == std::string::npos))
    throw Error("a {} file cannot hold {} channel{}; .tif and .exr hold any number", format.name,
                channels, channels == 1 ? "" : "s");
  // Beyond these, libjpeg ends the whole process.
  if (format.name == "jpeg" && std::max(size.width, size.height) > longest_side_of_jpeg)
    throw Error("a jpeg file cannot hold {}×{} pixels; a side has at most {}", size.width,
                size.height, longest_side_of_jpeg);
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

std::vector<std::string> channel_names(int channels, const Encoding& encoding) {
  const auto count = static_cast<std::size_t>(channels);
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

}  // namespace

// OpenImageIO sees the extension alone: in a name, '?' would mean something to it.
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

PixelType stored_type(const Format& format, PixelType type) {
  return format.stored_as[static_cast<std::size_t>(type)];
}

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

namespace {

/// What other programs print and lay out by. Nothing where the metadata has none.
void add_resolution(OIIO::ImageSpec& spec, const Metadata& metadata) {
  std::array<float, resolution_names.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto text = metadata.find(resolution_names[i]);
    if (text == metadata.end()) return;
    const char* const end = text->second.data() + text->second.size();
    const auto [read, error] = std::from_chars(text->second.data(), end, values[i]);
    if (error != std::errc() || read != end || values[i] <= 0) return;
    spec.attribute(resolution_names[i], values[i]);
  }
  // Some of OpenImageIO's writers take the second from the first and this.
  spec.attribute("PixelAspectRatio", values[1] / values[0]);
  if (const auto unit = metadata.find("ResolutionUnit"); unit != metadata.end())
    spec.attribute("ResolutionUnit", unit->second == "inch" ? "in" : unit->second);
}

}  // namespace

OIIO::ImageSpec make_spec(const Format& format, Size size, int channels, const Encoding& encoding,
                          const Metadata& metadata) {
  check_fits(format, size, channels);
  const PixelType type = stored_type(format, encoding.pixel_type);
  OIIO::ImageSpec spec(size.width, size.height, channels, oiio_type(type));
  spec.channelnames = channel_names(channels, encoding);
  const auto alpha = std::find(spec.channelnames.begin(), spec.channelnames.end(), "A");
  spec.alpha_channel =
      alpha == spec.channelnames.end() ? -1 : static_cast<int>(alpha - spec.channelnames.begin());
  // Or OpenImageIO divides colours by alpha; a TIFF says which of the two it has.
  if (format.name != "tiff" || !encoding.premultiplied) spec.attribute("oiio:UnassociatedAlpha", 1);
  // Of a TIFF OpenImageIO would write an EXIF part, and for it read what is already written:
  // neither a pipe nor our files can. The description says it.
  if (format.name != "tiff" && !encoding.colour_space.empty())
    spec.attribute("oiio:ColorSpace", encoding.colour_space);
  spec.attribute("ImageDescription", describe(format, {spec.channelnames, encoding.colour_space,
                                                       metadata, encoding.premultiplied}));
  if (!encoding.icc_profile.empty())
    spec.attribute(
        "ICCProfile",
        OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(encoding.icc_profile.size())),
        encoding.icc_profile.data());
  for (const char* name : {"Artist", "Copyright", "DocumentName"})
    if (const auto text = metadata.find(name); text != metadata.end())
      spec.attribute(name, text->second);
  add_resolution(spec, metadata);
  spec.attribute("DateTime", "");  // or OpenImageIO writes the time of day into TIFF and EXR
  if (format.name == "jpeg") {
    spec.attribute("Compression", "jpeg:98");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  return spec;
}

std::vector<std::byte> stored_values(const OIIO::ImageSpec& spec, const float* rows, int count) {
  std::vector<std::byte> values(spec.scanline_bytes() * static_cast<std::size_t>(count));
  OIIO::convert_image(spec.nchannels, spec.width, count, 1, rows, OIIO::TypeDesc::FLOAT,
                      OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride, values.data(),
                      spec.format, OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride);
  return values;
}

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

void count_clamped(const float* values, std::size_t count, PixelType type, Clamped& clamped) {
  const Limits limits = limits_of(type);
  clamped.values += count;
  for (std::size_t i = 0; i < count; ++i) {
    const float value = values[i];
    if (value < limits.low - limits.slack || value > limits.high + limits.slack) ++clamped.beyond;
    clamped.least = std::min(clamped.least, value);
    clamped.most = std::max(clamped.most, value);
  }
}

void note_clamped(const Clamped& clamped, PixelType type, std::vector<std::string>& notes) {
  if (clamped.beyond == 0) return;
  const Limits limits = limits_of(type);
  notes.push_back(fmt::format(
      "{:.3g} % of the values, which reach from {:.4g} to {:.4g}, were clamped to {:g} to {:g}",
      100.0 * static_cast<double>(clamped.beyond) / static_cast<double>(clamped.values),
      clamped.least, clamped.most, limits.low, limits.high));
}

void clamp_to_half(std::vector<float>& values) {
  const Limits limits = limits_of(PixelType::half);
  for (float& value : values) value = std::clamp(value, limits.low, limits.high);
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

}  // namespace gramloom
