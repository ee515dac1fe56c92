#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "io/check_finite.h"
#include "io/image_algorithms.h"
#include "io/image_file.h"
#include "io/image_format.h"
#include "io/image_record.h"
#include "io/image_values.h"
#include "io/pictures_module.h"
#include "io/png_chunks.h"
#include "io/quiet_stderr.h"
#include "io/regular_file.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

/// The reader that the name's ending suggests, or none. It is made by the ending alone: given a
/// name, OpenImageIO would look into a file of that name, with one reader after the other.
std::unique_ptr<OIIO::ImageInput> likely_reader(const fs::path& path) {
  const std::string ending = OIIO::Strutil::lower(path.extension().string());
  for (const auto& [format, endings] : OIIO::get_extension_map())
    for (const std::string& known : endings)
      if (ending == "." + known) {
        auto reader = OIIO::ImageInput::create(known);
        if (!reader) OIIO::geterror();  // or OpenImageIO prints it when the process ends
        return reader;
      }
  return nullptr;
}

std::unique_ptr<OIIO::ImageInput> open_image(const fs::path& path, const RegularFile& file) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // or OpenImageIO multiplies colours by alpha
  auto input = likely_reader(path);
  OIIO::ImageSpec spec;
  if (!input || !input->open(file.name(), spec, hints)) {
    OIIO::geterror();
    input = OIIO::ImageInput::open(file.name(), &hints);  // by the content
  }
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

PixelType pixel_type(OIIO::TypeDesc type) {
  if (type == OIIO::TypeDesc::UINT8) return PixelType::uint8;
  if (type == OIIO::TypeDesc::UINT16) return PixelType::uint16;
  if (type == OIIO::TypeDesc::HALF) return PixelType::half;
  return PixelType::float32;
}

/// OpenImageIO calls alpha associated unless a reader says otherwise; of these formats it knows.
bool is_premultiplied(const OIIO::ImageInput& input) {
  const std::string_view format = input.format_name();
  const OIIO::ImageSpec& spec = input.spec();
  return spec.alpha_channel >= 0 && (format == "openexr" || format == "tiff") &&
         spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
}

/// OpenImageIO's reader of WebP multiplies colours by alpha, in 8 bits, whatever it is asked.
void check_alpha(const OIIO::ImageInput& input, const Image& image) {
  const int alpha = input.spec().alpha_channel;
  if (alpha < 0 || std::string_view(input.format_name()) != "webp" ||
      input.spec().get_int_attribute("oiio:UnassociatedAlpha") != 0)
    return;
  for (std::size_t i = static_cast<std::size_t>(alpha); i < image.pixels.size();
       i += static_cast<std::size_t>(image.channels))
    if (image.pixels[i] < 1)
      throw Error("a transparent WebP would lose its colours on the way; convert it to PNG");
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

/// The resolution of the file as texts, of a picture that is turned as `orientation` says.
void take_resolution(const OIIO::ImageSpec& spec, int orientation, Metadata& metadata) {
  const bool lies = orientation >= 5;  // rows of the file are columns of the picture
  for (std::size_t i = 0; i < resolution_names.size(); ++i) {
    const char* of_file = resolution_names[lies ? resolution_names.size() - 1 - i : i];
    if (const float value = spec.get_float_attribute(of_file); value > 0)
      metadata[resolution_names[i]] = fmt::format("{}", value);
  }
  if (const std::string unit = spec.get_string_attribute("ResolutionUnit"); !unit.empty())
    metadata["ResolutionUnit"] = unit;
}

std::string icc_profile(const OIIO::ImageSpec& spec) {
  const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
  if (!profile || profile->type().basetype != OIIO::TypeDesc::UINT8) return "";
  return {static_cast<const char*>(profile->data()), profile->type().size()};
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

ImageFile read_open(OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  ImageFile file;
  file.image.width = spec.width;
  file.image.height = spec.height;
  file.image.channels = spec.nchannels;
  file.image.pixels = read_values(input, file.notes);
  check_finite(file.image);
  check_no_data(file.image);
  check_alpha(input, file.image);
  file.encoding = {pixel_type(spec.format), spec.get_string_attribute("oiio:ColorSpace"),
                   spec.channelnames, is_premultiplied(input)};
  file.encoding.icc_profile = icc_profile(spec);
  const auto record = from_description(spec.get_string_attribute("ImageDescription"));
  if (record && record->channel_names.size() == spec.channelnames.size()) {
    file.image = reorder_channels(std::move(file.image), spec.channelnames, record->channel_names);
    file.encoding.colour_space = record->colour_space;
    file.encoding.channel_names = record->channel_names;
    file.encoding.premultiplied = record->premultiplied;
    file.metadata = record->metadata;
  } else {
    file.metadata = texts(spec);
  }
  const int orientation = spec.get_int_attribute("Orientation", 1);
  take_resolution(spec, orientation, file.metadata);
  file.image = pictures::turn(std::move(file.image), orientation);
  return file;
}

/// A library's message with the file's own name where it has the one that we gave.
std::string with_name(std::string message, const std::string& from, const std::string& to) {
  if (from.empty()) return message;  // it would be found everywhere
  for (std::size_t at = message.find(from); at != std::string::npos;
       at = message.find(from, at + to.size()))
    message.replace(at, from.size(), to);
  return message;
}

// What `use` makes of the opened file, whose header is one that can be.
template <class Use>
auto with_opened(const fs::path& path, const Use& use) {
  std::string opened_as = path.string();
  try {
    const RegularFile file(path);
    opened_as = file.name();
    if (file.size() == 0) throw Error("the file is empty");
    const QuietStderr quiet;
    check_png_chunks(file.name());
    const auto input = open_image(path, file);
    check_header(input->spec(), file.size());
    return use(*input);
  } catch (const std::bad_alloc&) {  // OpenImageIO's readers let it through
    throw Error("{}: out of memory", path.string());
  } catch (const std::exception& error) {
    throw Error("{}: {}", path.string(),
                with_name(first_line(error.what()), opened_as, path.filename().string()));
  }
}

}  // namespace

ImageFile pictures::read(const fs::path& path) { return with_opened(path, read_open); }

Size pictures::read_size(const fs::path& path) {
  return with_opened(path, [](const OIIO::ImageInput& input) {
    return Size{input.spec().width, input.spec().height};
  });
}

}  // namespace gramloom
