#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace gramloom {

/// A regular file, open for reading; it closes itself.
///
/// Libraries are given name() in place of the path. Then they read the very file that was looked
/// at, and no letter of its name means anything to them: OpenImageIO takes what follows a '?' for
/// options.
class RegularFile {
 public:
  /// Never waits: a pipe would make the opener wait for a writer, and a device may have no end.
  /// Throws Error, without the path, for what is missing, unreadable, a folder, a pipe or a device.
  explicit RegularFile(const std::filesystem::path& path);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  std::uint64_t size() const { return size_; }  // bytes
  std::string name() const;                     // "/proc/self/fd/7"

 private:
  int descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace gramloom
