#include "classic/patch_features.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "signal/colour_pca.h"
#include "signal/patch_field.h"

namespace gramloom {

namespace {

constexpr int components = field_features - 1;

void set_structure(Image& features, double weight) {
  const cv::Mat values(features.height, features.width, CV_32FC(field_features),
                       features.pixels.data());
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
  cv::Scalar mean, deviation;
  cv::meanStdDev(structure, mean, deviation);
  const double scale = deviation[0] > 1e-6 ? weight / deviation[0] : 0;
  for (int y = 0; y < features.height; ++y)
    for (int x = 0; x < features.width; ++x)
      features.at(x, y)[components] =
          static_cast<float>((double{structure(y, x)} - mean[0]) * scale);
}

}  // namespace

Image patch_features(const Image& image, double structure) {
  const ColourPca pca = colour_pca(image);
  const double deviation = total_deviation(pca);
  Image features =
      along_axes(image, pca, deviation > 0 ? 1 / deviation : 0, components, field_features);
  set_structure(features, structure);
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
