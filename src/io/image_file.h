#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/image.h"

namespace gramloom {

/// How a file stores a value: 8- or 16-bit integers for [0, 1], half or single floats as they are.
enum class PixelType { uint8, uint16, half, float32 };
template <>
inline constexpr auto enum_names<PixelType> =
    std::to_array<std::string_view>({"uint8", "uint16", "half", "float"});

/// What a file knows of its pixels beyond their values; it travels from exemplar to result.
struct Encoding {
  PixelType pixel_type = PixelType::uint8;
  std::string colour_space;                // OpenImageIO's name, as read; "" when the file has none
  std::vector<std::string> channel_names;  // "R", "G", "B", "A", "height", …; empty: by count

  friend bool operator==(const Encoding&, const Encoding&) = default;
};

using Metadata = std::map<std::string, std::string>;

struct ImageFile {
  Image image;
  Encoding encoding;
  Metadata metadata;  // the text attributes
};

/// Reads any format that OpenImageIO reads, first subimage, all channels; alpha is a channel like
/// any other (never premultiplied, never dropped). Throws Error with the path for a file that is
/// missing, empty, truncated, corrupt, or larger than memory, and for NaN or infinite pixels.
ImageFile read_image(const std::filesystem::path& path);

/// Writes `image` in the format of the path's extension, complete or not at all (temporary name in
/// the same folder, then renamed). A pixel type that the format lacks becomes the next better one
/// that it has, or, where it has none better, its best. Integer types clamp to [0, 1] and round to
/// nearest. Throws Error with the path.
void write_image(const std::filesystem::path& path, const Image& image, const Encoding& encoding,
                 const Metadata& metadata = {});

}  // namespace gramloom
