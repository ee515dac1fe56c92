#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <vector>

#include "io/image_format.h"

namespace gramloom {

/// A picture on its way into the bytes of a file, row by row, and the notes of write_image(). What
/// it throws does not name the file.
class ImageEncoder {
 public:
  /// Throws Error when no format has this extension (".png"), or it cannot hold such a picture.
  ImageEncoder(const std::string& extension, Size size, int channels, const Encoding& encoding,
               const Metadata& metadata);
  ~ImageEncoder();
  ImageEncoder(const ImageEncoder&) = delete;
  ImageEncoder& operator=(const ImageEncoder&) = delete;

  /// To where the bytes go; it must outlive the encoder.
  void open(OIIO::Filesystem::IOProxy& file);
  /// The next `count` rows, interleaved floats. Throws Error with the place of a NaN or infinite
  /// value.
  void write(const float* rows, int count);
  /// After the last row.
  void close();
  /// A line for each way in which the file has less than what was written.
  std::vector<std::string> notes() const;

 private:
  void write_scanlines(const float* rows, int count);
  void check(bool done) const;

  std::string extension_;
  std::unique_ptr<OIIO::ImageOutput> output_;
  const Format& format_;
  Encoding encoding_;
  PixelType stored_;
  OIIO::ImageSpec spec_;
  Clamped clamped_;
  bool has_alpha_ = false;  // a value of it other than 1 was written
  int next_row_ = 0;
};

}  // namespace gramloom
