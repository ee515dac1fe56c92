#include "signal/channel_groups.h"

#include <algorithm>

namespace gramloom {

Image filtered_in_groups(const Image& image, Size size,
                         const std::function<void(const cv::Mat& from, cv::Mat& to)>& filter) {
  constexpr int group = 4;
  Image result(size, image.channels);
  for (int first = 0; first < image.channels; first += group) {
    const int count = std::min(group, image.channels - first);
    Image part = extract_channels(image, first, count);
    const cv::Mat from(part.height, part.width, CV_32FC(count), part.pixels.data());
    cv::Mat to;
    filter(from, to);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        std::copy_n(to.ptr<float>(y) + x * count, count, result.at(x, y) + first);
  }
  return result;
}

}  // namespace gramloom
