#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/image.h"

namespace gramloom {

/// How a file stores a value: 8- or 16-bit unsigned integers for [0, 1], half or single floats as
/// they are.
enum class PixelType { uint8, uint16, half, float32 };
template <>
inline constexpr auto enum_names<PixelType> = std::to_array<std::string_view>({"uint8", "uint16",
                                                                               "half", "float"});

/// What a file knows of its pixels beyond their values; it travels from exemplar to result.
struct Encoding {
  PixelType pixel_type = PixelType::uint8;
  std::string colour_space;                // OpenImageIO's name, as read; "" when the file has none
  std::vector<std::string> channel_names;  // "R", "G", "B", "A", "height", …; empty: by count
  bool premultiplied = false;              // colours are multiplied by the channel "A"
  std::string icc_profile = {};            // bytes; what the colours mean; "" when there is none

  friend bool operator==(const Encoding&, const Encoding&) = default;
};

/// The most pixels on a side of a JPEG file.
inline constexpr int longest_side_of_jpeg = 65500;

/// Texts in a file by name. Use names with a prefix ("gramloom:settings") for what is ours.
using Metadata = std::map<std::string, std::string>;

struct ImageFile {
  Image image;
  Encoding encoding;
  Metadata metadata;  // of a file of ours: what write_image was given; else its text attributes
  std::vector<std::string> notes;  // where `image` is not quite what the file holds: a line each
};

/// Reads any format that OpenImageIO reads, first subimage, all channels. A camera's note to turn
/// the picture (EXIF orientation) is followed. Palettes are expanded, CMYK becomes RGB.
///
/// Signed integers and integers of 32 bits come as the numbers that the file holds, with the pixel
/// type float, and a note where a float cannot hold them exactly. Doubles and 64 bits are refused.
///
/// Alpha is a channel like any other: never dropped, and colours come as the file stores them,
/// neither multiplied nor divided by it. So colour under zero alpha is kept. `premultiplied` says
/// which of the two they are: those of an EXR are by convention, a TIFF says so itself.
///
/// The name is only a name: the file is opened here, and its content and ending tell the format.
///
/// Throws Error with the path for a file that is missing, a pipe or a device, empty, truncated,
/// corrupt or larger than memory, for a header that claims far more pixels than a file of its
/// length can hold (before anything is allocated), for NaN or infinite pixels, for values of ±1e30
/// or more (missing data), integers of 64 bits, and a WebP that is transparent anywhere.
ImageFile read_image(const std::filesystem::path& path);

/// Its width and height by the file's header, before the picture is turned. Throws as read_image()
/// does, but for what only the pixels show.
Size read_image_size(const std::filesystem::path& path);

/// Writes `image` as PNG, JPEG, TIFF, EXR, TGA, BMP, PNM or HDR, by the path's extension, complete
/// or not at all (see write_text). The same image gives the same bytes: there are no dates inside.
///
/// A pixel type that the format lacks becomes the next better one that it has, or, where it has
/// none better, its best: half in TIFF becomes float; half and float in PNG uint16; uint8 in EXR
/// half. Integer types clamp to [0, 1] and round to nearest, half clamps to ±65504. JPEG is written
/// at quality 98 without colour subsampling. Colours are never multiplied or divided by alpha.
///
/// Returns notes, a line for each way in which the file has less than `image`: values that were
/// clamped, a type that is coarser than the one asked for, colours that are premultiplied in a
/// format where they never are, or the other way round.
///
/// Channel names count when there is one for each channel; else they are Y; Y, A; R, G, B; R, G, B,
/// A; and from the fifth on "channel4", …. Names, colour space and metadata come back from
/// read_image for PNG, JPEG, TIFF and EXR: they are one JSON text in the image description
/// ({"gramloom": {"channels": […], "colour_space": "…", "metadata": {…}}}), the attribute that all
/// of these have. An ICC profile comes back from PNG, JPEG and TIFF, and so do an artist and a
/// copyright in the metadata, which are written as the formats' own too. TGA, BMP, PNM and HDR have
/// none and lose them.
///
/// Throws Error with the path for an unknown extension, channels that the format cannot hold (JPEG
/// has no alpha), a JPEG with a side above 65500 or more than 60 kB of metadata, NaN or infinite
/// pixels, two channels of one name, and for a file that cannot be written.
std::vector<std::string> write_image(const std::filesystem::path& path, const Image& image,
                                     const Encoding& encoding, const Metadata& metadata = {});

/// The pixel type that a file with this extension (".png") has when `type` is asked for. Throws
/// Error for an extension that write_image refuses.
PixelType stored_type(const std::string& extension, PixelType type);

}  // namespace gramloom
