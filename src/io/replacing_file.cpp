#include "io/replacing_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <random>
#include <utility>

#include "core/error.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

Error cannot_write(const fs::path& path) {
  return Error("{}: cannot write: {}", path.string(), std::strerror(errno));
}

// Keeps writers of other machines in the same folder apart.
unsigned token() {
  static const unsigned number = std::random_device{}();
  return number;
}

// Another name in the folder of `path`: the process and a count keep writers apart, too.
fs::path temporary_name(const fs::path& path) {
  static std::atomic<unsigned> count{0};
  // A file name has at most 255 bytes.
  return path.parent_path() / fmt::format(".{}.{:08x}.{}.{}.tmp",
                                          path.filename().string().substr(0, 200), token(),
                                          getpid(), count.fetch_add(1));
}

}  // namespace

ReplacingFile::ReplacingFile(fs::path path)
    : path_(std::move(path)),
      temporary_(temporary_name(path_)),
      descriptor_(
          open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw cannot_write(path_);
}

ReplacingFile::~ReplacingFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void ReplacingFile::commit() {
  // Some file systems report a full disk only when the file is closed.
  if (fsync(descriptor_) != 0 || close(std::exchange(descriptor_, -1)) != 0 ||
      rename(temporary_.c_str(), path_.c_str()) != 0)
    throw cannot_write(path_);
  temporary_.clear();
  // The new name survives a power cut only once its folder is on the disk, too.
  const int folder = open(path_.has_parent_path() ? path_.parent_path().c_str() : ".",
                          O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  fsync(folder);
  close(folder);
}

}  // namespace gramloom
