#include "signal/blur.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"

namespace gramloom {

Image blurred(const Image& image, double deviation, Tile wraps) {
  if (image.empty()) throw Error("an empty image cannot be blurred");
  const int reach = static_cast<int>(std::ceil(4 * deviation));
  const auto beyond = [&](bool tiles) { return tiles ? cv::BORDER_WRAP : cv::BORDER_REFLECT; };
  Image result(image.size(), image.channels);
  // Channel by channel: OpenCV's filters promise no more than four at a time.
  for (int c = 0; c < image.channels; ++c) {
    cv::Mat plane(image.height, image.width, CV_32F), wide, smooth;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) plane.at<float>(y, x) = image.at(x, y)[c];
    cv::copyMakeBorder(plane, wide, 0, 0, reach, reach, beyond(tiles_x(wraps)));
    cv::copyMakeBorder(wide, wide, reach, reach, 0, 0, beyond(tiles_y(wraps)));
    cv::GaussianBlur(wide, smooth, {2 * reach + 1, 2 * reach + 1}, deviation, deviation,
                     cv::BORDER_REPLICATE);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        result.at(x, y)[c] = smooth.at<float>(y + reach, x + reach);
  }
  return result;
}

}  // namespace gramloom
