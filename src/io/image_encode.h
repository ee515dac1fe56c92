#pragma once

#include <string>

#include "io/image_file.h"

namespace gramloom {

/// The bytes of the file that write_image() would write under a name with this extension (".png").
std::string encoded_image(const std::string& extension, const Image& image,
                          const Encoding& encoding);

}  // namespace gramloom
