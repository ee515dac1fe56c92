#include "io/image_rows.h"

#include <OpenImageIO/filesystem.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <new>
#include <string_view>

#include "core/error.h"
#include "io/image_format.h"
#include "io/json_text.h"
#include "io/pictures_module.h"
#include "io/quiet_stderr.h"
#include "io/replacing_file.h"

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
    std::int64_t at = m_pos - std::ssize(waiting_);
    for (std::string_view left = waiting_; !left.empty() && error_ == 0;) {
      const ssize_t count = ::pwrite(descriptor_, left.data(), left.size(), at);
      if (count > 0) {
        left.remove_prefix(static_cast<std::size_t>(count));
        at += count;
      } else if (count == 0) {
        error_ = EIO;  // or it would be tried for ever
      } else if (errno != EINTR) {
        error_ = errno;
      }
    }
    waiting_.clear();
  }
  int error() const { return error_; }

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
      : path_(std::move(path)),
        row_values_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(channels)) {
    const std::string extension = path_.extension().string();
    output_ = writer_for(extension);
    const Format& format = format_of(output_.get(), extension);
    const OIIO::ImageSpec spec = make_spec(format, size, channels, encoding, metadata);
    stored_ = stored_type(format, encoding.pixel_type);
    note_coarser_type(format, encoding.pixel_type, stored_, notes_);
    file_ = std::make_unique<ReplacingFile>(path_);
    proxy_ = std::make_unique<WatchedFile>(file_->descriptor());
    const QuietStderr quiet;
    check(output_->set_ioproxy(proxy_.get()) && output_->open("image" + extension, spec));
  }

  ~RowsToFile() override {
    const QuietStderr quiet;
    output_.reset();  // before what it writes to
  }

  void write(const float* rows, int count) override {
    const std::size_t values = row_values_ * static_cast<std::size_t>(count);
    for (std::size_t i = 0; i < values; ++i)
      if (!std::isfinite(rows[i])) throw Error("{}: holds NaN or infinite values", path_.string());
    const std::size_t beyond = clamped_.beyond;
    count_clamped(rows, values, stored_, clamped_);
    if (clamped_.beyond > beyond && stored_ == PixelType::half) {
      std::vector<float> held(rows, rows + values);
      clamp_to_half(held);
      write_scanlines(held.data(), count);
    } else {
      write_scanlines(rows, count);
    }
  }

  std::vector<std::string> finish() override {
    const QuietStderr quiet;
    const bool closed = output_->close();
    proxy_->send();
    check(closed);
    file_->commit();
    note_clamped(clamped_, stored_, notes_);
    return notes_;
  }

 private:
  void write_scanlines(const float* rows, int count) {
    const QuietStderr quiet;
    const auto values = stored_values(output_->spec(), rows, count);
    check(output_->write_scanlines(next_row_, next_row_ + count, 0, output_->spec().format,
                                   values.data()));
    next_row_ += count;
  }
  void check(bool done) const {
    if (proxy_->error() != 0)
      throw Error("{}: cannot write: {}", path_.string(), std::strerror(proxy_->error()));
    if (!done) throw Error("{}: cannot be encoded: {}", path_.string(), output_->geterror());
  }

  fs::path path_;
  std::size_t row_values_;
  PixelType stored_ = PixelType::uint8;
  Clamped clamped_;
  std::vector<std::string> notes_;
  int next_row_ = 0;
  std::unique_ptr<ReplacingFile> file_;
  std::unique_ptr<WatchedFile> proxy_;
  std::unique_ptr<OIIO::ImageOutput> output_;
};

}  // namespace

std::unique_ptr<ImageRows> pictures::open_rows(const fs::path& path, Size size, int channels,
                                               const Encoding& encoding, const Metadata& metadata) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw Error("{}: cannot write row by row: it is not a file", path.string());
  try {
    return std::make_unique<RowsToFile>(path, size, channels, encoding, metadata);
  } catch (const std::exception& error) {
    const std::string message = message_of(error);
    if (message.starts_with(path.string())) throw Error("{}", message);
    throw Error("{}: {}", path.string(), message);
  }
}

}  // namespace gramloom
