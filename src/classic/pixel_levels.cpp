#include "classic/pixel_levels.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace gramloom::pixel {
namespace {

constexpr int most_channels = 4;

cv::Mat view(Image& image) {
  return cv::Mat(image.height, image.width, CV_32FC(image.channels), image.pixels.data());
}
cv::Mat view(const Image& image) { return view(const_cast<Image&>(image)); }

}  // namespace

Image comparison_colours(const Image& image, const ColourPca& pca) {
  const double deviation = total_deviation(pca);
  const double scale = deviation > 0 ? 1 / deviation : 0;
  Image result = extract_channels(whitened(image, pca), 0, std::min(image.channels, most_channels));
  const auto channels = static_cast<std::size_t>(result.channels);
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
    result.pixels[i] *=
        static_cast<float>(static_cast<double>(pca.deviation[i % channels]) * scale);
  return result;
}

Image blurred(const Image& image) {
  static const cv::Mat taps = (cv::Mat_<float>(1, 5) << 1, 4, 6, 4, 1) / 16;
  Image result(image.size(), image.channels);
  cv::Mat out = view(result);
  cv::sepFilter2D(view(image), out, CV_32F, taps, taps, {-1, -1}, 0, cv::BORDER_REFLECT_101);
  return result;
}

Image halved_samples(const Image& image) {
  Image result((image.width + 1) / 2, (image.height + 1) / 2, image.channels);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      std::copy_n(image.at(2 * x, 2 * y), image.channels, result.at(x, y));
  return result;
}

std::vector<Level> make_levels(const Image& exemplar, int count) {
  std::vector<Level> levels{{comparison_colours(exemplar, colour_pca(exemplar)), 1, 1}};
  while (static_cast<int>(levels.size()) < count) {
    const Image& finer = levels.back().colours;
    if (levels.size() == 1)
      levels.push_back({blurred(finer), 2, 1});
    else
      levels.push_back({blurred(halved_samples(finer)), 2, 2});
  }
  return levels;
}

int level_count(int asked, Size exemplar, Size result) {
  const int smallest = asked > 0 ? 2 : 40;
  int side = std::min({exemplar.width, exemplar.height, result.width, result.height});
  int levels = 1;
  for (; side >= smallest && levels != asked; side /= 2) ++levels;
  return levels;
}

Image mirrored(const Image& image, int border) {
  Image result(image.width + 2 * border, image.height + 2 * border, image.channels);
  cv::Mat out = view(result);
  cv::copyMakeBorder(view(image), out, border, border, border, border, cv::BORDER_REFLECT_101);
  return result;
}

}  // namespace gramloom::pixel
