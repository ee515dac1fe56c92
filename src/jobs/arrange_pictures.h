#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gramloom {

/// What `arrange` is asked: to lay pictures as a texture's coordinates say.
struct ArrangeWork {
  std::filesystem::path coordinates;
  std::vector<std::filesystem::path> pictures;  // in the order of the exemplar's
  std::filesystem::path output;
};

/// Writes the pictures' pixels in that arrangement, no value changed, in the first one's pixel type
/// where the file can hold it; returns notes where it can't. Throws ConfigError for pictures of
/// another number, size or number of channels than the texture was made of, and for an output that
/// is one of them or that this command did not make; Error for files.
std::vector<std::string> arrange_pictures(const ArrangeWork& work);

}  // namespace gramloom
