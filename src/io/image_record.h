#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/image_file.h"

namespace gramloom {

/// What an image file carries beside its pixels, as one text in the image description: the one
/// attribute that PNG, JPEG, TIFF and EXR all have.
struct ImageRecord {
  std::vector<std::string> channel_names;  // in the order of the channels in memory
  std::string colour_space;
  Metadata metadata;
  bool premultiplied = false;  // as in Encoding
};

/// In ASCII, for the formats that know no other letters.
std::string to_description(const ImageRecord& record);

/// Nothing when the description is not one of ours.
std::optional<ImageRecord> from_description(const std::string& description);

}  // namespace gramloom
