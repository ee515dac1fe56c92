#include "io/image_encoder.h"

#include "core/error.h"
#include "io/check_finite.h"
#include "io/quiet_stderr.h"

namespace gramloom {

namespace {

// Of alpha: whether there is any. Where it is 1 everywhere, colours are the same either way.
bool has_value_but_one(const float* rows, std::size_t values, int alpha, int channels) {
  for (auto i = static_cast<std::size_t>(alpha); i < values;
       i += static_cast<std::size_t>(channels))
    if (rows[i] != 1) return true;
  return false;
}

}  // namespace

ImageEncoder::ImageEncoder(const std::string& extension, Size size, int channels,
                           const Encoding& encoding, const Metadata& metadata)
    : extension_(extension),
      output_(writer_for(extension)),
      format_(format_of(output_.get(), extension)),
      encoding_(encoding),
      stored_(stored_type(format_, encoding.pixel_type)),
      spec_(make_spec(format_, size, channels, encoding, metadata)) {}

ImageEncoder::~ImageEncoder() {
  const QuietStderr quiet;
  output_.reset();
}

void ImageEncoder::open(OIIO::Filesystem::IOProxy& file) {
  const QuietStderr quiet;
  check(output_->set_ioproxy(&file) && output_->open("image" + extension_, spec_));
}

void ImageEncoder::write(const float* rows, int count) {
  const std::size_t values = static_cast<std::size_t>(spec_.width) *
                             static_cast<std::size_t>(spec_.nchannels) *
                             static_cast<std::size_t>(count);
  check_finite(rows, values, spec_.width, spec_.nchannels, next_row_);
  if (spec_.alpha_channel >= 0 && !has_alpha_)
    has_alpha_ = has_value_but_one(rows, values, spec_.alpha_channel, spec_.nchannels);
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

void ImageEncoder::write_scanlines(const float* rows, int count) {
  const QuietStderr quiet;
  const OIIO::ImageSpec& opened = output_->spec();
  const auto values = stored_values(opened, rows, count);
  check(output_->write_scanlines(next_row_, next_row_ + count, 0, opened.format, values.data()));
  next_row_ += count;
}

void ImageEncoder::close() {
  const QuietStderr quiet;
  check(output_->close());
}

std::vector<std::string> ImageEncoder::notes() const {
  std::vector<std::string> notes;
  note_coarser_type(format_, encoding_.pixel_type, stored_, notes);
  note_clamped(clamped_, stored_, notes);
  // Colours and alpha stay as they are; but other programs expect of each format the one or the
  // other. A TIFF says which it has.
  if (has_alpha_ && format_.name != "tiff" &&
      encoding_.premultiplied != (format_.name == "openexr"))
    notes.push_back(fmt::format("colours are {}multiplied by alpha, which is unusual in a {} file",
                                encoding_.premultiplied ? "" : "not ", format_.name));
  return notes;
}

void ImageEncoder::check(bool done) const {
  if (!done) throw Error("cannot be encoded: {}", output_->geterror());
}

}  // namespace gramloom
