#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

/// When the newest of these files was written. A file that is made of them gets their time with
/// set_time(), so that it shows whether they have changed, also back in time, as where a clock was
/// set. To be asked before they are read.
std::filesystem::file_time_type newest_time(const std::vector<std::filesystem::path>& files);
bool has_time(const std::filesystem::path& file, std::filesystem::file_time_type time);
void set_time(const std::filesystem::path& file, std::filesystem::file_time_type time);

/// Where the preview of a picture is, both from the run's folder on: page/FILE.png.
std::filesystem::path preview_file(const std::filesystem::path& file);

/// The path, relative to `folder`, of a picture that browsers show: `file` itself or, for EXR, TIFF
/// and the like, a preview of it in folder/page, which is made when it is missing or of another
/// time. Throws Error.
std::string shown_file(const std::filesystem::path& folder, const std::string& file, double white);

}  // namespace gramloom
