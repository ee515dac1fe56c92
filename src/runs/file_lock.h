#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gramloom {

/// A lock between processes, also on several machines that share a folder: a file that is locked
/// by flock(), which on NFS is a lock of the server's. It ends with the process, however that ends,
/// and on NFS with the machine, once the server misses it: so what is left of the dead can be taken
/// up. The file says who holds it and is removed with the lock.
class FileLock {
 public:
  enum class Mode { shared, exclusive };

  /// None when another process, or lock of this one, is in the way. Throws Error with the path
  /// where nothing can be written or locked.
  static std::optional<FileLock> take(const std::filesystem::path& path, Mode mode);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

  /// Lets others share an exclusive lock. False when one was faster and is in the way.
  bool share();

 private:
  FileLock(std::filesystem::path path, int descriptor);

  std::filesystem::path path_;
  int descriptor_;
};

/// The lock that a killed process has left, to do with what else it left; none where there is no
/// such file, or where someone holds it.
std::optional<FileLock> take_stale_lock(const std::filesystem::path& path);

/// Who holds a lock, as its file says: "process 123 on HOST"; "" where that is not known.
std::string holder_of(const std::filesystem::path& path);

/// Whether the file of a lock is one of ours, or none: another's is locked, but not written to.
bool is_lock(const std::filesystem::path& path);

}  // namespace gramloom
