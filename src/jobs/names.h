#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace gramloom {

/// The most bytes of a file's or folder's name on disk.
inline constexpr std::size_t longest_file_name = 255;
/// Of a map's name: it stands in "seed2147483647_NAME.exr".
inline constexpr std::size_t longest_map_name =
    longest_file_name - std::string_view("seed2147483647_.exr").size();

/// Fails for a name that cannot be part of a path on every file system, or is longer than that many
/// bytes.
void check_name(const std::string& name, std::size_t longest, const toml::source_region& region);

/// A to Z as a to z, for disks that don't tell them apart; other letters stay.
std::string in_small_letters(std::string text);

/// Whether `name` is `word`, alone or with the extension of a file of ours, on such a disk too.
bool is_own_file(const std::string& name, std::string_view word);

/// Names of one kind, each there once.
class NamesInUse {
 public:
  /// Fails for a name that is in use, or differs from one that is in capitals alone.
  void add(const std::string& name, const toml::source_region& region);

 private:
  std::map<std::string, std::string> by_small_letters_;
};

}  // namespace gramloom
