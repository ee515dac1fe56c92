#pragma once

#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

namespace gramloom {

/// All values of an opened picture: integers of 8 and 16 bits as 0 to 1, floats and other integers
/// as the numbers that they are, with a note where a float is not quite one. Throws Error for other
/// types, and where the file has fewer than its header says.
std::vector<float> read_values(OIIO::ImageInput& input, std::vector<std::string>& notes);

}  // namespace gramloom
