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

cv::Mat box_mean(const cv::Mat& values) {
  cv::Mat means;
  cv::blur(values, means, {9, 9}, {-1, -1}, cv::BORDER_REFLECT);
  return means;
}

/// The means over those of 9×9 pixels whose mask is 1, of which each pixel in question is one.
cv::Mat masked_mean(const cv::Mat& values, const Image& mask) {
  cv::Mat counted = values.clone();
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (*mask.at(x, y) <= 0.5f) counted.at<cv::Vec<float, field_features>>(y, x) = {};
  cv::Mat means = box_mean(counted);
  counted.release();
  const cv::Mat1f shares =
      box_mean(cv::Mat(mask.height, mask.width, CV_32F, const_cast<float*>(mask.pixels.data())));
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (shares(y, x) > 0) means.at<cv::Vec<float, field_features>>(y, x) /= shares(y, x);
  return means;
}

/// How much each pixel's components differ from their means.
cv::Mat1f structure_of(Image& features, const Image& mask) {
  const cv::Mat values = matrix(features);
  const cv::Mat means = mask.empty() ? box_mean(values) : masked_mean(values, mask);
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
  return patch_features(image, {}, structure, axes);
}

Image patch_features(const Image& image, const Image& mask, double structure, FeatureAxes& axes) {
  axes.pca = colour_pca(image);
  const double deviation = total_deviation(axes.pca);
  axes.scale = deviation > 0 ? 1 / deviation : 0;
  Image features = along_axes(image, axes.pca, axes.scale, components, field_features);
  const cv::Mat1f values = structure_of(features, mask);
  cv::Scalar mean, spread;
  if (mask.empty()) {
    cv::meanStdDev(values, mean, spread);
  } else {
    cv::Mat1b counted(values.size());
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x) counted(y, x) = *mask.at(x, y) > 0.5f ? 1 : 0;
    cv::meanStdDev(values, mean, spread, counted);
  }
  axes.structure_mean = mean[0];
  axes.structure_scale = spread[0] > 1e-6 ? structure / spread[0] : 0;
  set_structure(features, values, axes);
  return features;
}

Image patch_features(const Image& image, const Image& mask, const FeatureAxes& axes) {
  Image features = along_axes(image, axes.pca, axes.scale, components, field_features);
  set_structure(features, structure_of(features, mask), axes);
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
