#include "metrics/components.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "signal/mirror.h"

namespace gramloom {

ColourFrame colour_frame(const Image& exemplar) {
  ColourFrame frame{colour_pca(exemplar), 1};
  double largest = 0;
  for (const float v : exemplar.pixels) largest = std::max(largest, std::abs(double{v}));
  const double unit = std::max(total_deviation(frame.pca), 1e-3 * largest);
  if (unit > 0) frame.scale = 1 / unit;
  return frame;
}

Image components(const Image& image, const ColourFrame& frame) {
  return at_least(along_axes(image, frame.pca, frame.scale, component_count, component_count),
                  smallest_scored_side);
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
