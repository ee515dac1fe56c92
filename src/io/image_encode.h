#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/image_file.h"

namespace gramloom {

/// The bytes of the file that write_image() would write under a name with this extension (".png").
std::string encoded_image(const std::string& extension, const Image& image,
                          const Encoding& encoding);

/// The values that write_image() puts into a file that holds this type, in the machine's bytes.
std::vector<std::byte> stored_pixels(const Image& image, PixelType type);

}  // namespace gramloom
