#include "io/text_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "io/replacing_file.h"
#include "io/write_all.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

Error system_error(const fs::path& path, std::string_view what) {
  return Error("{}: cannot {}: {}", path.string(), what, std::strerror(errno));
}

/// An open file descriptor that closes itself.
class File {
 public:
  /// Opening never waits for the other end of a pipe.
  File(const fs::path& path, int flags)
      : descriptor_(open(path.c_str(), flags | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666)) {}
  ~File() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  mode_t mode() const {
    struct stat status {};
    return fstat(descriptor_, &status) == 0 ? status.st_mode : 0;
  }
  /// Some file systems report a full disk only when the file is closed.
  bool close_now() { return close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_;
};

void write_device(const fs::path& path, std::string_view text) {
  File file(path, O_WRONLY);
  if (!file.is_open() || !write_all(file.descriptor(), text) || !file.close_now())
    throw system_error(path, "write");
}

void replace_file(const fs::path& path, std::string_view text) {
  ReplacingFile file(path);
  if (!write_all(file.descriptor(), text)) throw system_error(path, "write");
  file.commit();
}

// /dev/null or a terminal.
bool is_harmless(int device) {
  struct stat status {};
  struct stat null {};
  return isatty(device) != 0 || (fstat(device, &status) == 0 && stat("/dev/null", &null) == 0 &&
                                 status.st_rdev == null.st_rdev);
}

}  // namespace

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

void read_blocks(const fs::path& path, const std::function<void(std::string_view)>& use) {
  const File file(path, O_RDONLY);
  if (!file.is_open()) throw system_error(path, "read");
  // A terminal or nothing may be read; other devices have no end, or wait for an event.
  if (S_ISBLK(file.mode()) || (S_ISCHR(file.mode()) && !is_harmless(file.descriptor())))
    throw Error("{}: cannot read: it is a device, not a file", path.string());
  constexpr std::size_t most = std::size_t{64} << 20;  // of what has no length of its own
  std::size_t all = 0;
  std::string buffer(std::size_t{1} << 20, '\0');
  for (;;) {
    const ssize_t count = read(file.descriptor(), buffer.data(), buffer.size());
    if (count < 0 && wait_for(file.descriptor(), POLLIN)) continue;
    if (count < 0) throw system_error(path, "read");
    if (count == 0) return;
    use(std::string_view(buffer).substr(0, static_cast<std::size_t>(count)));
    all += static_cast<std::size_t>(count);
    if (all > most && !S_ISREG(file.mode()))
      throw Error("{}: cannot read: more than {} MB come out of it", path.string(), most >> 20);
  }
}

std::string read_text(const fs::path& path) {
  std::string text;
  std::error_code ignored;
  const auto size = fs::file_size(path, ignored);  // a pipe has none
  if (!ignored) text.reserve(size);
  read_blocks(path, [&](std::string_view block) { text.append(block); });
  return text;
}

void write_text(const fs::path& path, std::string_view text) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) throw Error("{}: cannot write: Is a directory", path.string());
  if (fs::exists(status) && !fs::is_regular_file(status))
    write_device(path, text);
  else
    replace_file(path, text);
}

}  // namespace gramloom
