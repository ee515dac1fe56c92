#include "io/image_rows.h"

#include <OpenImageIO/filesystem.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "io/image_format.h"
#include "io/json_text.h"
#include "io/pictures_module.h"
#include "io/quiet_stderr.h"
#include "io/replacing_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

struct CloseStream {
  void operator()(FILE* stream) const { std::fclose(stream); }
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
    stream_.reset(fdopen(dup(file_->descriptor()), "wb"));
    if (!stream_) throw Error("cannot write");
    proxy_ =
        std::make_unique<OIIO::Filesystem::IOFile>(stream_.get(), OIIO::Filesystem::IOProxy::Write);
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
    check(output_->close());
    if (std::fclose(stream_.release()) != 0) throw Error("{}: cannot write", path_.string());
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
    if (!done) throw Error("{}: cannot be encoded: {}", path_.string(), output_->geterror());
  }

  fs::path path_;
  std::size_t row_values_;
  PixelType stored_ = PixelType::uint8;
  Clamped clamped_;
  std::vector<std::string> notes_;
  int next_row_ = 0;
  std::unique_ptr<ReplacingFile> file_;
  std::unique_ptr<FILE, CloseStream> stream_;
  std::unique_ptr<OIIO::Filesystem::IOFile> proxy_;
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
