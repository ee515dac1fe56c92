#include "io/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace gramloom {

namespace {

std::string kind_of_file(mode_t mode) {
  if (S_ISDIR(mode)) return "Is a directory";
  if (S_ISFIFO(mode)) return "it is a pipe, not a file";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "it is a device, not a file";
  return "it is not a file";
}

}  // namespace

RegularFile::RegularFile(const std::filesystem::path& path)
    : descriptor_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw Error("cannot read: {}", std::strerror(errno));
  struct stat status {};
  std::string trouble;
  if (fstat(descriptor_, &status) != 0)
    trouble = std::strerror(errno);
  else if (!S_ISREG(status.st_mode))
    trouble = kind_of_file(status.st_mode);
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (trouble.empty()) return;
  close(descriptor_);
  throw Error("cannot read: {}", trouble);
}

RegularFile::~RegularFile() { close(descriptor_); }

std::string RegularFile::name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

}  // namespace gramloom
