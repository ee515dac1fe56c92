#pragma once

#include <filesystem>
#include <vector>

namespace gramloom {

/// Writes a commented config to start from: each of these pictures is an exemplar, and each picture
/// of a folder; of none, a picture that comes with gramloom. Other keys stand there as comments,
/// with their defaults. Throws ConfigError for a file that is there already, for pictures that
/// cannot be read, and for a name that is not *.toml.
void write_new_config(const std::filesystem::path& file,
                      const std::vector<std::filesystem::path>& pictures);

}  // namespace gramloom
