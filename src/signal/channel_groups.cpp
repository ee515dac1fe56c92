#include "signal/channel_groups.h"

#include <algorithm>

namespace gramloom {

Image filtered_in_groups(const Image& image, Size size,
                         const std::function<void(const cv::Mat& from, cv::Mat& to)>& filter) {
  constexpr int group = 4;
  Image result(size, image.channels);
  for (int first = 0; first < image.channels; first += group) {
    const int count = std::min(group, image.channels - first);
    Image part;
    if (count < image.channels) part = extract_channels(image, first, count);
    const Image& some = part.empty() ? image : part;
    const cv::Mat from(some.height, some.width, CV_32FC(count),
                       const_cast<float*>(some.pixels.data()));  // which is only read
    cv::Mat to;
    filter(from, to);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        std::copy_n(to.ptr<float>(y) + x * count, count, result.at(x, y) + first);
  }
  return result;
}

}  // namespace gramloom
