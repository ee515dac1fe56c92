#include "io/image_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/error.h"
#include "io/text_file.h"

namespace gramloom {

namespace {

/// OpenImageIO converts 256 rows at once, and takes the memory of as many where there are only two,
/// of a million pixels each.
bool is_converted_by_us(const OIIO::ImageSpec& spec) {
  constexpr std::size_t rows_at_once = 256, harmless = 1 << 28;
  return spec.channelformats.empty() && spec.scanline_bytes() * rows_at_once > harmless &&
         static_cast<std::size_t>(spec.height) < rows_at_once;
}

bool read_values_into(OIIO::ImageInput& input, OIIO::TypeDesc type, void* values) {
  const OIIO::ImageSpec spec = input.spec();
  if (!is_converted_by_us(spec)) return input.read_image(0, 0, 0, spec.nchannels, type, values);
  std::vector<std::byte> stored(spec.image_bytes());
  return input.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UNKNOWN, stored.data()) &&
         OIIO::convert_image(spec.nchannels, spec.width, spec.height, spec.depth, stored.data(),
                             spec.format, OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride,
                             values, type, OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride);
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
  const bool complete = read_values_into(input, stored_as<T>, values.data());
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

}  // namespace

std::vector<float> read_values(OIIO::ImageInput& input, std::vector<std::string>& notes) {
  const OIIO::ImageSpec spec = input.spec();
  for (int c = 0; c < spec.nchannels; ++c)
    if (!is_common(type_of(spec, c))) return read_numbers(input, notes);
  std::vector<float> values = read_all<float>(input);
  if (spec.format == OIIO::TypeDesc::UINT8) snap(values, 255.0f);
  if (spec.format == OIIO::TypeDesc::UINT16) snap(values, 65535.0f);
  return values;
}

}  // namespace gramloom
