#include "io/image_algorithms.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include "core/error.h"
#include "io/pictures_module.h"

namespace gramloom {

namespace {

OIIO::ImageSpec spec_of(const Image& image) {
  return {image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT};
}

// A view of the image's own pixels, which OpenImageIO only reads.
OIIO::ImageBuf view(const Image& image, const OIIO::ImageSpec& spec) {
  return {spec, const_cast<float*>(image.pixels.data())};
}

// ImageBufAlgo::reorient() of OpenImageIO 2.4 takes 5 for 7 and 7 for 5.
OIIO::ImageBuf reoriented(const OIIO::ImageBuf& image, int orientation) {
  using namespace OIIO::ImageBufAlgo;
  switch (orientation) {
    case 2:
      return flop(image);
    case 3:
      return rotate180(image);
    case 4:
      return flip(image);
    case 5:
      return transpose(image);
    case 6:
      return rotate90(image);
    case 7:
      return transpose(rotate180(image));
    default:
      return rotate270(image);
  }
}

}  // namespace

Image pictures::turn(Image image, int orientation) {
  if (orientation < 2 || orientation > 8) return image;
  const OIIO::ImageBuf turned = reoriented(view(image, spec_of(image)), orientation);
  Image result(turned.spec().width, turned.spec().height, image.channels);
  if (turned.has_error() ||
      !turned.get_pixels(turned.roi(), OIIO::TypeDesc::FLOAT, result.pixels.data()))
    throw Error("cannot be turned: {}", turned.geterror());
  return result;
}

PixelDifference pictures::difference(const Image& a, const Image& b, double tolerance) {
  if (a.size() != b.size() || a.channels != b.channels)
    throw Error("pictures of different sizes or channels cannot be compared");
  const auto limit = static_cast<float>(tolerance);
  const auto found =
      OIIO::ImageBufAlgo::compare(view(a, spec_of(a)), view(b, spec_of(b)), limit, limit);
  const double pixels = static_cast<double>(a.width) * a.height;
  return {static_cast<double>(found.nfail) / pixels, found.maxerror};
}

}  // namespace gramloom
