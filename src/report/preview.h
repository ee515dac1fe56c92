#pragma once

#include <filesystem>
#include <string>

#include "io/image_file.h"

namespace gramloom {

/// The value that previews show as white: 1, or for floats that go beyond it, the value below which
/// 99.5 % of them lie. An exemplar's serves its results too, so that they compare.
double white_of(const ImageFile& file);

/// The picture as 8-bit sRGB, with alpha when it has 2 or 4 channels; of others the first 3, or the
/// first. Values of a colour space called linear get sRGB's curve (IEC 61966-2-1).
Image preview(const ImageFile& file, double white);

/// Whether browsers show a file of this name.
bool browsers_show(const std::filesystem::path& file);

/// Whether a file that is made of another one is missing, or older than that.
bool is_older(const std::filesystem::path& file, const std::filesystem::path& than);

/// Where the preview of a picture is, both from the run's folder on: page/FILE.png.
std::filesystem::path preview_file(const std::filesystem::path& file);

/// The path, relative to `folder`, of a picture that browsers show: `file` itself or, for EXR, TIFF
/// and the like, a preview of it in folder/page, which is made when it is missing or older.
/// Throws Error.
std::string shown_file(const std::filesystem::path& folder, const std::string& file, double white);

}  // namespace gramloom
