#include "classic/pixel_levels.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/threads.h"

namespace gramloom::pixel {
namespace {

constexpr int most_channels = 4;

cv::Mat view(Image& image) {
  return cv::Mat(image.height, image.width, CV_32FC(image.channels), image.pixels.data());
}
cv::Mat view(const Image& image) { return view(const_cast<Image&>(image)); }

std::vector<double> channel_means(const Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<double> means(channels, 0.0);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    means[i % channels] += static_cast<double>(image.pixels[i]);
  for (double& mean : means)
    mean *= static_cast<double>(channels) / static_cast<double>(image.pixels.size());
  return means;
}

cv::Mat channel_covariance(const Image& image, const std::vector<double>& means) {
  const int n = image.channels;
  const int pixels = image.width * image.height;
  cv::Mat covariance = cv::Mat::zeros(n, n, CV_64F);
  std::vector<double> centred(means.size());
  for (int p = 0; p < pixels; ++p) {
    const float* values = image.pixels.data() + static_cast<std::size_t>(p) * means.size();
    for (std::size_t c = 0; c < means.size(); ++c)
      centred[c] = static_cast<double>(values[c]) - means[c];
    for (int a = 0; a < n; ++a)
      for (int b = 0; b <= a; ++b)
        covariance.at<double>(a, b) +=
            centred[static_cast<std::size_t>(a)] * centred[static_cast<std::size_t>(b)];
  }
  cv::completeSymm(covariance, true);
  return covariance / pixels;
}

/// The exemplar's channels, or their 4 principal components, with mean 0 and total variance 1.
Image comparison_colours(const Image& exemplar) {
  const auto means = channel_means(exemplar);
  const cv::Mat covariance = channel_covariance(exemplar, means);
  const double variance = cv::trace(covariance)[0];
  const double scale = variance > 0 ? 1 / std::sqrt(variance) : 0;
  cv::Mat axes = cv::Mat::eye(exemplar.channels, exemplar.channels, CV_64F);
  if (exemplar.channels > most_channels) {
    cv::Mat values;
    cv::eigen(covariance, values, axes);
  }
  Image result(exemplar.size(), std::min(exemplar.channels, most_channels));
  const auto from = static_cast<std::size_t>(exemplar.channels);
  const auto to = static_cast<std::size_t>(result.channels);
  for (std::size_t p = 0; p < result.pixels.size() / to; ++p)
    for (std::size_t c = 0; c < to; ++c) {
      double sum = 0;
      for (std::size_t i = 0; i < from; ++i)
        sum += axes.at<double>(static_cast<int>(c), static_cast<int>(i)) *
               (static_cast<double>(exemplar.pixels[p * from + i]) - means[i]);
      result.pixels[p * to + c] = static_cast<float>(sum * scale);
    }
  return result;
}

/// The 5-tap binomial filter of the Gaussian pyramid.
Image blurred(const Image& image) {
  static const cv::Mat taps = (cv::Mat_<float>(1, 5) << 1, 4, 6, 4, 1) / 16;
  Image result(image.size(), image.channels);
  cv::Mat out = view(result);
  cv::sepFilter2D(view(image), out, CV_32F, taps, taps, {-1, -1}, 0, cv::BORDER_REFLECT_101);
  return result;
}

/// Every second sample, from the first.
Image halved(const Image& image) {
  Image result((image.width + 1) / 2, (image.height + 1) / 2, image.channels);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      std::copy_n(image.at(2 * x, 2 * y), image.channels, result.at(x, y));
  return result;
}

}  // namespace

std::vector<Level> make_levels(const Image& exemplar, int count) {
  std::vector<Level> levels{{comparison_colours(exemplar), 1, 1}};
  while (static_cast<int>(levels.size()) < count) {
    const Image& finer = levels.back().colours;
    if (levels.size() == 1)
      levels.push_back({blurred(finer), 2, 1});
    else
      levels.push_back({blurred(halved(finer)), 2, 2});
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
