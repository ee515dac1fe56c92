#include "signal/resize.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "signal/channel_groups.h"

namespace gramloom {
namespace {

Image resize_by(const Image& image, Size size, int interpolation) {
  return filtered_in_groups(image, size, [&](const cv::Mat& from, cv::Mat& to) {
    cv::resize(from, to, {size.width, size.height}, 0, 0, interpolation);
  });
}

}  // namespace

Image resize(const Image& image, Size size) {
  if (image.empty()) throw Error("an empty image cannot be resized");
  if (size.width < 1 || size.height < 1)
    throw Error("an image cannot be resized to {}×{} pixels", size.width, size.height);
  const Size smaller{std::min(size.width, image.width), std::min(size.height, image.height)};
  Image result = smaller == image.size() ? image : resize_by(image, smaller, cv::INTER_AREA);
  if (size == smaller) return result;
  result = resize_by(result, size, cv::INTER_CUBIC);
  clamp_to(result, channel_range(image));
  return result;
}

Image fit_longer_side(const Image& image, int max_side) {
  if (max_side < 1) throw Error("the longer side of an image cannot be {} pixels", max_side);
  const int longer = std::max(image.width, image.height);
  if (longer <= max_side) return image;
  const double scale = static_cast<double>(max_side) / longer;
  const auto scaled = [&](int side) {
    return std::max(1, static_cast<int>(std::lround(side * scale)));
  };
  return resize(image, {scaled(image.width), scaled(image.height)});
}

}  // namespace gramloom
