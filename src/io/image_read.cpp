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

/// The values of a whole file, as the type T.
template <class T>
inline constexpr OIIO::TypeDesc::BASETYPE stored_as = OIIO::BaseTypeFromC<T>::value;
template <>  // OpenImageIO knows this type as char, which may have no sign
inline constexpr OIIO::TypeDesc::BASETYPE stored_as<std::int8_t> = OIIO::TypeDesc::INT8;

template <class T>
std::vector<T> read_all(OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  std::vector<T> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  const bool complete = input.read_image(0, 0, 0, spec.nchannels, stored_as<T>, values.data());
  // The JPEG reader fills what is missing with grey and only leaves a message. One of its messages
  // is harmless: bytes between two parts of the file that no part needs.
  const std::string message = first_line(input.geterror());
  if (!complete || (!message.empty() && message.find("extraneous bytes") == std::string::npos))
    throw Error("truncated or damaged{}{}", message.empty() ? "" : ": ", message);
  return values;
}

OIIO::TypeDesc type_of(const OIIO::ImageSpec& spec, int channel) {
  return spec.channelformats.empty() ? spec.format : spec.channelformat(channel);
}

/// Whether OpenImageIO's values are ours: integers of 8 and 16 bits that become 0 to 1, and floats.
bool is_common(OIIO::TypeDesc type) {
  return type == OIIO::TypeDesc::UINT8 || type == OIIO::TypeDesc::UINT16 ||
         type == OIIO::TypeDesc::HALF || type == OIIO::TypeDesc::FLOAT;
}

template <class T>
std::vector<double> numbers_of(OIIO::ImageInput& input) {
  const std::vector<T> values = read_all<T>(input);
  return {values.begin(), values.end()};
}

/// The numbers of a type that is not common as they are in the file: heights in metres, say.
std::vector<double> read_as_stored(OIIO::ImageInput& input) {
  const OIIO::ImageSpec& spec = input.spec();
  if (!spec.channelformats.empty()) throw Error("its channels have different types of values");
  switch (spec.format.basetype) {
    case OIIO::TypeDesc::INT8:
      return numbers_of<std::int8_t>(input);
    case OIIO::TypeDesc::INT16:
      return numbers_of<std::int16_t>(input);
    case OIIO::TypeDesc::INT32:
      return numbers_of<std::int32_t>(input);
    case OIIO::TypeDesc::UINT32:
      return numbers_of<std::uint32_t>(input);
    default:
      throw Error("values of type {} cannot be read; convert it to float or 16 bits",
                  spec.format.c_str());
  }
}

/// OpenImageIO multiplies by a rounded 1 / max; this makes k / max of it, the nearest float.
void snap(std::vector<float>& values, float max) {
  for (float& value : values) value = std::round(value * max) / max;
}

/// As floats; `notes` says when they are not what the file holds.
std::vector<float> read_numbers(OIIO::ImageInput& input, std::vector<std::string>& notes) {
  const std::vector<double> numbers = read_as_stored(input);
  std::vector<float> floats(numbers.size());
  double furthest = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    floats[i] = static_cast<float>(numbers[i]);
    furthest = std::max(furthest, std::abs(numbers[i] - static_cast<double>(floats[i])));
  }
  if (furthest > 0)
    notes.push_back(fmt::format("{} values were rounded to float, by up to {:.2g}",
                                input.spec().format.c_str(), furthest));
  return floats;
}

std::vector<float> read_values(OIIO::ImageInput& input, std::vector<std::string>& notes) {
  const OIIO::ImageSpec spec = input.spec();
  for (int c = 0; c < spec.nchannels; ++c)
    if (!is_common(type_of(spec, c))) return read_numbers(input, notes);
  std::vector<float> values = read_all<float>(input);
  if (spec.format == OIIO::TypeDesc::UINT8) snap(values, 255.0f);
  if (spec.format == OIIO::TypeDesc::UINT16) snap(values, 65535.0f);
  return values;
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
