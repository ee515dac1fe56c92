#include "classic/patch_features.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "signal/patch_origin.h"

namespace gramloom {

namespace {

constexpr int components = field_features - 1;

cv::Mat matrix(Image& image) {
  return {image.height, image.width, CV_32FC(image.channels), image.pixels.data()};
}

/// How much each pixel's components differ from their means.
cv::Mat1f structure_of(Image& features) {
  const cv::Mat values = matrix(features);
  cv::Mat means;
  cv::blur(values, means, {9, 9}, {-1, -1}, cv::BORDER_REFLECT);
  cv::Mat1f structure(values.size());
  for (int y = 0; y < features.height; ++y)
    for (int x = 0; x < features.width; ++x) {
      const float *value = features.at(x, y), *mean = means.ptr<float>(y, x);
      float sum = 0;
      for (int k = 0; k < components; ++k) sum += (value[k] - mean[k]) * (value[k] - mean[k]);
      structure(y, x) = std::sqrt(sum);
    }
  return structure;
}

void set_structure(Image& features, const cv::Mat1f& structure, const FeatureAxes& axes) {
  for (int y = 0; y < features.height; ++y)
    for (int x = 0; x < features.width; ++x)
      features.at(x, y)[components] = static_cast<float>(
          (double{structure(y, x)} - axes.structure_mean) * axes.structure_scale);
}

}  // namespace

Image patch_features(const Image& image, double structure) {
  FeatureAxes axes;
  return patch_features(image, structure, axes);
}

Image patch_features(const Image& image, double structure, FeatureAxes& axes) {
  axes.pca = colour_pca(image);
  const double deviation = total_deviation(axes.pca);
  axes.scale = deviation > 0 ? 1 / deviation : 0;
  Image features = along_axes(image, axes.pca, axes.scale, components, field_features);
  if (structure <= 0) return features;
  const cv::Mat1f values = structure_of(features);
  cv::Scalar mean, spread;
  cv::meanStdDev(values, mean, spread);
  axes.structure_mean = mean[0];
  axes.structure_scale = spread[0] > 1e-6 ? structure / spread[0] : 0;
  set_structure(features, values, axes);
  return features;
}

Image patch_features(const Image& image, const FeatureAxes& axes) {
  Image features = along_axes(image, axes.pca, axes.scale, components, field_features);
  if (axes.structure_scale > 0) set_structure(features, structure_of(features), axes);
  return features;
}

Image halved(const Image& image) {
  Image half(image.width / 2, image.height / 2, image.channels);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      const float *above = image.at(2 * x, 2 * y), *below = image.at(2 * x, 2 * y + 1);
      for (int c = 0; c < image.channels; ++c)
        half.at(x, y)[c] =
            ((above[c] + above[c + image.channels]) + (below[c] + below[c + image.channels])) / 4;
    }
  return half;
}

}  // namespace gramloom
