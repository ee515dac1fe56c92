#pragma once

#include <filesystem>

namespace gramloom {

/// Keeps a second run out of a folder for as long as it lives. The lock is on the folder itself
/// (flock), so that it leaves no file and ends with the process, however that ends.
class FolderLock {
 public:
  /// Throws Error when another process holds the lock. Where the file system has no locks there is
  /// none.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int descriptor_;
};

}  // namespace gramloom
