#include "classic/patch_features.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "classic/patch_field.h"
#include "signal/colour_pca.h"

namespace gramloom {

namespace {

constexpr int components = field_features - 1;

/// Features 0 to 2; the last is left 0.
void set_components(const Image& image, Image& features) {
  const ColourPca pca = colour_pca(image);
  double variance = 0;
  for (const float deviation : pca.deviation) variance += double{deviation} * double{deviation};
  const double scale = variance > 0 ? 1 / std::sqrt(variance) : 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int k = 0; k < std::min(components, image.channels); ++k) {
        const float* axis = pca.axes.data() + k * image.channels;
        double sum = 0;
        for (int c = 0; c < image.channels; ++c)
          sum += double{axis[c]} *
                 (double{image.at(x, y)[c]} - double{pca.mean[static_cast<std::size_t>(c)]});
        features.at(x, y)[k] = static_cast<float>(sum * scale);
      }
}

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
  Image features(image.size(), field_features);
  set_components(image, features);
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

int mirrored(int i, int length) {
  i %= 2 * length;
  return i < length ? i : 2 * length - 1 - i;
}

Image at_least(const Image& image, int side) {
  Image result(std::max(image.width, side), std::max(image.height, side), image.channels);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      std::copy_n(image.at(mirrored(x, image.width), mirrored(y, image.height)), image.channels,
                  result.at(x, y));
  return result;
}

}  // namespace gramloom
