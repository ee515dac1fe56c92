#include <OpenImageIO/imageio.h>
#include <OpenImageIO/sysutil.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "io/check_finite.h"
#include "io/image_file.h"
#include "io/image_record.h"
#include "io/pictures_module.h"
#include "io/png_chunks.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

std::string first_line(std::string text) {
  text.resize(std::min(text.find('\n'), text.size()));
  return text;
}

std::unique_ptr<OIIO::ImageInput> open_image(const fs::path& path) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // or OpenImageIO multiplies colours by alpha
  auto input = OIIO::ImageInput::open(path.string(), &hints);
  if (!input) throw Error("not an image that can be read: {}", first_line(OIIO::geterror()));
  // OpenImageIO's stand-in for tests: black, whatever the file holds.
  if (std::string_view(input->format_name()) == "null") throw Error("not an image");
  return input;
}

/// Before any pixel is read or any memory taken, so that a header cannot make us take too much.
void check_header(const OIIO::ImageSpec& spec, std::uintmax_t file_bytes) {
  if (spec.deep || spec.depth > 1) throw Error("deep and volume images cannot be read");
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
    throw Error("the header claims {}×{} pixels of {} channels", spec.width, spec.height,
                spec.nchannels);
  const double values = static_cast<double>(spec.width) * spec.height * spec.nchannels;
  const double stored = values * static_cast<double>(spec.format.size());
  // Deflate, the best compressor among the lossless formats, reaches 1032 to 1. Small images may
  // claim anything: a few flat colours in WebP or JPEG 2000 do better, and cost nothing.
  constexpr double harmless = 256e6, best_ratio = 4096;
  if (stored > harmless && stored > best_ratio * static_cast<double>(file_bytes))
    throw Error("the header claims {}×{} pixels of {} channels, too many for a file of {} bytes",
                spec.width, spec.height, spec.nchannels, file_bytes);
  const double memory = static_cast<double>(OIIO::Sysutil::physical_memory());
  if (values * sizeof(float) > memory)
    throw Error("{}×{} pixels of {} channels need {:.0f} GB, more than this machine's memory",
                spec.width, spec.height, spec.nchannels, values * sizeof(float) / 1e9);
}

/// OpenImageIO multiplies by a rounded 1 / max; this makes k / max of it, the nearest float.
void snap(Image& image, float max) {
  for (float& value : image.pixels) value = std::round(value * max) / max;
}

Image read_pixels(OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  Image image(spec.width, spec.height, spec.nchannels);
  const bool complete =
      input.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data());
  // The JPEG reader fills what is missing with grey and only leaves a message. One of its messages
  // is harmless: bytes between two parts of the file that no part needs.
  const std::string message = first_line(input.geterror());
  if (!complete || (!message.empty() && message.find("extraneous bytes") == std::string::npos))
    throw Error("truncated or damaged{}{}", message.empty() ? "" : ": ", message);
  if (spec.format == OIIO::TypeDesc::UINT8) snap(image, 255.0f);
  if (spec.format == OIIO::TypeDesc::UINT16) snap(image, 65535.0f);
  return image;
}

PixelType pixel_type(OIIO::TypeDesc type) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
    case OIIO::TypeDesc::INT8:
      return PixelType::uint8;
    case OIIO::TypeDesc::UINT16:
    case OIIO::TypeDesc::INT16:
      return PixelType::uint16;
    case OIIO::TypeDesc::HALF:
      return PixelType::half;
    default:
      return PixelType::float32;
  }
}

/// The texts of a file that isn't ours.
Metadata texts(const OIIO::ImageSpec& spec) {
  Metadata metadata;
  for (const auto& attribute : spec.extra_attribs)
    if (attribute.type() == OIIO::TypeDesc::STRING &&
        !attribute.name().string().starts_with("oiio:"))
      metadata[attribute.name().string()] = attribute.get_string();
  return metadata;
}

/// EXR files sort their channels by name; this brings them back into the order they were written
/// in.
Image reorder_channels(Image image, const std::vector<std::string>& from,
                       const std::vector<std::string>& to) {
  if (from == to || !std::is_permutation(from.begin(), from.end(), to.begin(), to.end()))
    return image;
  std::vector<std::ptrdiff_t> source;
  for (const std::string& name : to)
    source.push_back(std::find(from.begin(), from.end(), name) - from.begin());
  std::vector<float> pixel(source.size());
  for (auto at = image.pixels.begin(); at != image.pixels.end(); at += image.channels) {
    std::transform(source.begin(), source.end(), pixel.begin(),
                   [&](std::ptrdiff_t channel) { return at[channel]; });
    std::copy(pixel.begin(), pixel.end(), at);
  }
  return image;
}

/// Turns and mirrors a picture as the EXIF orientation (1 to 8) says that it is to be seen.
Image orient(const Image& image, int orientation) {
  if (orientation < 2 || orientation > 8) return image;
  const bool transpose = orientation >= 5;
  const bool flip_x = orientation == 2 || orientation == 3 || orientation >= 7;
  const bool flip_y = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  Image result(transpose ? image.height : image.width, transpose ? image.width : image.height,
               image.channels);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      const int u = transpose ? y : x, v = transpose ? x : y;
      std::copy_n(image.at(flip_x ? image.width - 1 - u : u, flip_y ? image.height - 1 - v : v),
                  image.channels, result.at(x, y));
    }
  return result;
}

ImageFile read_open(OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  ImageFile file;
  file.image = read_pixels(input);
  check_finite(file.image);
  file.encoding = {pixel_type(spec.format), spec.get_string_attribute("oiio:ColorSpace"),
                   spec.channelnames};
  const auto record = from_description(spec.get_string_attribute("ImageDescription"));
  if (record && record->channel_names.size() == spec.channelnames.size()) {
    file.image = reorder_channels(std::move(file.image), spec.channelnames, record->channel_names);
    file.encoding.colour_space = record->colour_space;
    file.encoding.channel_names = record->channel_names;
    file.metadata = record->metadata;
  } else {
    file.metadata = texts(spec);
  }
  file.image = orient(file.image, spec.get_int_attribute("Orientation", 1));
  return file;
}

}  // namespace

ImageFile pictures::read(const fs::path& path) {
  try {
    check_png_chunks(path);
    const auto input = open_image(path);
    std::error_code ignored;
    const auto file_bytes = fs::file_size(path, ignored);
    check_header(input->spec(), ignored ? 0 : file_bytes);
    return read_open(*input);
  } catch (const std::exception& error) {  // OpenImageIO's readers also let bad_alloc through
    throw Error("{}: {}", path.string(), first_line(error.what()));
  }
}

}  // namespace gramloom
