#include "io/image_rows.h"

#include <OpenImageIO/filesystem.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <new>

#include "core/error.h"
#include "io/image_encoder.h"
#include "io/pictures_module.h"
#include "io/replacing_file.h"
#include "io/with_path.h"
#include "io/write_all.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// Keeps to itself that it could not write, and why: some of OpenImageIO's writers do not look, and
// of others the library below ends the process, or throws where nothing may be thrown.
class WatchedFile : public OIIO::Filesystem::IOProxy {
 public:
  explicit WatchedFile(int descriptor) : IOProxy("", Write), descriptor_(descriptor) {}
  // libjpeg would write to the stream of a "file" itself, and end the process when that fails; of
  // any other kind OpenImageIO takes a JPEG's bytes from memory.
  const char* proxytype() const override { return "watched"; }
  bool seek(std::int64_t offset) override {
    send();
    m_pos = offset;
    return true;
  }
  std::size_t write(const void* bytes, std::size_t size) override {
    constexpr std::size_t enough = 1 << 20;
    try {
      waiting_.append(static_cast<const char*>(bytes), size);
    } catch (const std::bad_alloc&) {
      if (error_ == 0) error_ = ENOMEM;
    }
    m_pos += static_cast<std::int64_t>(size);
    size_ = std::max(size_, static_cast<std::size_t>(m_pos));
    if (waiting_.size() >= enough) send();
    return size;
  }
  std::size_t size() const override { return size_; }

  // To the disk, what was written since the last time.
  void send() {
    const std::int64_t at = m_pos - std::ssize(waiting_);
    if (error_ == 0 && !waiting_.empty() &&
        (lseek(descriptor_, at, SEEK_SET) < 0 || !write_all(descriptor_, waiting_)))
      error_ = errno;
    waiting_.clear();
  }
  // Throws Error with the path when not all could be written.
  void check(const fs::path& path) const {
    if (error_ != 0) throw Error("{}: cannot write: {}", path.string(), std::strerror(error_));
  }

 private:
  int descriptor_;
  std::string waiting_;
  std::size_t size_ = 0;
  int error_ = 0;
};

class RowsToFile : public ImageRows {
 public:
  RowsToFile(fs::path path, Size size, int channels, const Encoding& encoding,
             const Metadata& metadata)
      : path_(std::move(path)) {
    // Before there is a file.
    auto encoder = std::make_unique<ImageEncoder>(path_.extension().string(), size, channels,
                                                  encoding, metadata);
    file_ = std::make_unique<ReplacingFile>(path_);
    proxy_ = std::make_unique<WatchedFile>(file_->descriptor());
    encoder_ = std::move(encoder);
    watch([&] { encoder_->open(*proxy_); });
  }

  void write(const float* rows, int count) override {
    watch([&] { encoder_->write(rows, count); });
  }

  std::vector<std::string> finish() override {
    watch([&] {
      encoder_->close();
      proxy_->send();
    });
    file_->commit();
    return encoder_->notes();
  }

 private:
  // A file that could not be written is the reason for whatever else went wrong.
  void watch(const std::function<void()>& step) {
    try {
      with_path(path_, step);
    } catch (const Error&) {
      proxy_->check(path_);
      throw;
    }
    proxy_->check(path_);
  }

  fs::path path_;
  std::unique_ptr<ReplacingFile> file_;
  std::unique_ptr<WatchedFile> proxy_;
  std::unique_ptr<ImageEncoder> encoder_;  // goes first, as it may still write
};

}  // namespace

std::unique_ptr<ImageRows> pictures::open_rows(const fs::path& path, Size size, int channels,
                                               const Encoding& encoding, const Metadata& metadata) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw Error("{}: cannot write row by row: it is not a file", path.string());
  return with_path(
      path, [&] { return std::make_unique<RowsToFile>(path, size, channels, encoding, metadata); });
}

}  // namespace gramloom
