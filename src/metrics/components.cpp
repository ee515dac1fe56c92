#include "metrics/components.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "classic/patch_features.h"
#include "core/threads.h"

namespace gramloom {

ColourFrame colour_frame(const Image& exemplar) {
  ColourFrame frame{colour_pca(exemplar), 1};
  double variance = 0, largest = 0;
  for (const float d : frame.pca.deviation) variance += double{d} * double{d};
  for (const float v : exemplar.pixels) largest = std::max(largest, std::abs(double{v}));
  const double unit = std::max(std::sqrt(variance), 1e-3 * largest);
  if (unit > 0) frame.scale = 1 / unit;
  return frame;
}

Image components(const Image& image, const ColourFrame& frame) {
  Image result(image.size(), component_count);
  const int used = std::min(component_count, image.channels);
  parallel_for(image.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int k = 0; k < used; ++k) {
          const float* axis = frame.pca.axes.data() + k * image.channels;
          double sum = 0;
          for (int c = 0; c < image.channels; ++c)
            sum += double{axis[c]} * (double{image.at(x, y)[c]} -
                                      double{frame.pca.mean[static_cast<std::size_t>(c)]});
          result.at(x, y)[k] = static_cast<float>(sum * frame.scale);
        }
  });
  return at_least(result, smallest_side);
}

Image smoothly_halved(const Image& components) {
  const cv::Mat in(components.height, components.width, CV_32FC(component_count),
                   const_cast<float*>(components.pixels.data()));
  cv::Mat smooth;
  cv::GaussianBlur(in, smooth, {}, 1.2, 1.2, cv::BORDER_REFLECT);
  Image half((components.width + 1) / 2, (components.height + 1) / 2, component_count);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      std::copy_n(smooth.ptr<float>(2 * y, 2 * x), component_count, half.at(x, y));
  return half;
}

}  // namespace gramloom
