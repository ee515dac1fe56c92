#pragma once

#include <filesystem>

namespace gramloom {

/// A new file that appears under its name complete or not at all: it is written as a temporary file
/// in the same folder (".NAME.TOKEN.PID.COUNT.tmp"), which is gone afterwards whatever happens
/// short of SIGKILL.
class ReplacingFile {
 public:
  /// Throws Error with the path: no such folder, not writable.
  explicit ReplacingFile(std::filesystem::path path);
  ~ReplacingFile();
  ReplacingFile(const ReplacingFile&) = delete;
  ReplacingFile& operator=(const ReplacingFile&) = delete;

  /// Of the temporary file, to write to.
  int descriptor() const { return descriptor_; }
  /// Flushes it to the disk and gives it its name, in place of a file that has it. Throws Error
  /// with the path.
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
};

}  // namespace gramloom
