#pragma once

#include <filesystem>

namespace gramloom {

/// Throws Error when the file begins like a PNG but does not go on to its end mark, chunk after
/// chunk. libpng does not miss what follows the last pixel, and prints lines of its own about what
/// it does miss; other files pass.
void check_png_chunks(const std::filesystem::path& path);

}  // namespace gramloom
