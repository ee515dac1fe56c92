#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "io/image_file.h"

namespace gramloom {

// What the module of pictures knows of the formats that it writes.

/// What a format can hold. We write only those that keep alpha as it is, and report what they
/// cannot do: of the others, OpenImageIO drops channels or multiplies colours by alpha without a
/// word.
struct Format {
  std::string_view name;                 // OpenImageIO's
  std::string_view channels;             // the counts it holds; "" for any
  std::array<PixelType, 4> stored_as{};  // for each PixelType
};

/// For files with this extension (".png"); null when there is none.
std::unique_ptr<OIIO::ImageOutput> writer_for(const std::string& extension);
/// The writer's format. Throws Error when it is none that we write.
const Format& format_of(const OIIO::ImageOutput* output, const std::string& extension);
PixelType stored_type(const Format& format, PixelType type);
OIIO::TypeDesc oiio_type(PixelType type);
/// Of a picture as `encoding` says. Throws Error when the format cannot hold it.
OIIO::ImageSpec make_spec(const Format& format, Size size, int channels, const Encoding& encoding,
                          const Metadata& metadata);

/// Attributes that are numbers, and texts among our metadata. Not the ratio of the two, which
/// OpenImageIO's readers do not agree on.
inline constexpr std::array<const char*, 2> resolution_names{"XResolution", "YResolution"};

/// Rows of values as the file holds them. Of floats OpenImageIO would convert one row after the
/// other, each with all of its threads, and wait.
std::vector<std::byte> stored_values(const OIIO::ImageSpec& spec, const float* rows, int count);

/// The smallest and largest value that a type holds, and by how much one may lie beyond and still
/// only be rounded.
struct Limits {
  float low, high, slack;
};
Limits limits_of(PixelType type);

/// Values that lie beyond what a type holds.
struct Clamped {
  std::size_t values = 0, beyond = 0;
  float least = 0, most = 0;
};
void count_clamped(const float* values, std::size_t count, PixelType type, Clamped& clamped);
/// A line, where there are such values.
void note_clamped(const Clamped& clamped, PixelType type, std::vector<std::string>& notes);
/// OpenImageIO clamps for integers, and makes infinity of what half cannot hold.
void clamp_to_half(std::vector<float>& values);
/// A line, where the stored type is the coarser one.
void note_coarser_type(const Format& format, PixelType wanted, PixelType stored,
                       std::vector<std::string>& notes);

}  // namespace gramloom
