#include "runs/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/polling.h"
#include "io/text_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds patience{60};

constexpr std::string_view mark = "held by gramloom, ";

std::string text_of_lock() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  return fmt::format("{}process {} on {}\n", mark, getpid(), host.data());
}

// Whether the file is still the one under its name: another may have removed it meanwhile.
bool is_under_its_name(int descriptor, const fs::path& path) {
  struct stat ours {
  }, named{};
  return fstat(descriptor, &ours) == 0 && ours.st_nlink > 0 && stat(path.c_str(), &named) == 0 &&
         ours.st_ino == named.st_ino && ours.st_dev == named.st_dev;
}

// False when another lock is in the way.
bool lock(int descriptor, int how, const fs::path& path) {
  while (flock(descriptor, how | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return false;
    if (errno != EINTR) throw Error("{}: cannot lock: {}", path.string(), std::strerror(errno));
  }
  return true;
}

// For people to read: what keeps others out is the lock.
void write_holder(int descriptor) {
  const std::string text = text_of_lock();
  if (ftruncate(descriptor, 0) == 0) [[maybe_unused]]
    const ssize_t written = pwrite(descriptor, text.data(), text.size(), 0);
}

}  // namespace

std::optional<FileLock> FileLock::take(const fs::path& path, Mode mode) {
  for (;;) {
    const int descriptor =
        open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NOCTTY, 0666);
    if (descriptor < 0) throw Error("{}: cannot write: {}", path.string(), std::strerror(errno));
    FileLock taken("", descriptor);
    if (!lock(descriptor, mode == Mode::shared ? LOCK_SH : LOCK_EX, path)) return std::nullopt;
    if (!is_under_its_name(descriptor, path)) continue;
    if (mode == Mode::exclusive && is_lock(path)) write_holder(descriptor);
    taken.path_ = path;
    return taken;
  }
}

FileLock::FileLock(fs::path path, int descriptor)
    : path_(std::move(path)), descriptor_(descriptor) {}

FileLock::FileLock(FileLock&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  // The last of those who share it removes it.
  if (!path_.empty() && is_lock(path_) && is_under_its_name(descriptor_, path_) &&
      flock(descriptor_, LOCK_EX | LOCK_NB) == 0)
    unlink(path_.c_str());
  close(descriptor_);
}

bool FileLock::share() {
  // The system gives the exclusive lock up first: another may have it for a moment.
  return comes_true(patience, [&] { return lock(descriptor_, LOCK_SH, path_); });
}

std::optional<FileLock> take_stale_lock(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored) || !is_lock(path)) return std::nullopt;
  try {
    return FileLock::take(path, FileLock::Mode::exclusive);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string holder_of(const fs::path& path) {
  try {
    const std::string text = read_text(path);
    if (text.starts_with(mark) && text.ends_with('\n'))
      return text.substr(mark.size(), text.size() - mark.size() - 1);
  } catch (const Error&) {
  }
  return "";
}

bool is_lock(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return true;
  if (!fs::is_regular_file(path, ignored)) return false;
  return fs::file_size(path, ignored) == 0 || !holder_of(path).empty();
}

}  // namespace gramloom
