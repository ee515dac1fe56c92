#include "metrics/random_features.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/random.h"
#include "core/simd.h"
#include "core/threads.h"
#include "metrics/components.h"
#include "signal/fourier.h"

namespace gramloom {

namespace {

constexpr std::uint64_t filter_seed = 0x68656c646f7574;  // of no synthesis
constexpr int first_filters = 16, second_filters = 32;
static_assert(first_filters + second_filters == RandomFeatures::count);
constexpr int most_scales = 4;
constexpr int smallest_scale = 16;  // pixels

constexpr int lanes = 16;
typedef float Lanes __attribute__((vector_size(lanes * sizeof(float)), aligned(4), may_alias));

/// Σ a b, in runs short enough for float.
GRAMLOOM_SIMD double dot(const float* a, const float* b, std::size_t count) {
  constexpr std::size_t run = 2048;
  double total = 0;
  for (std::size_t begin = 0; begin < count; begin += run) {
    const std::size_t end = std::min(count, begin + run);
    Lanes sums = {};
    std::size_t i = begin;
    for (; i + lanes <= end; i += lanes)
      sums += *reinterpret_cast<const Lanes*>(a + i) * *reinterpret_cast<const Lanes*>(b + i);
    for (int k = 0; k < lanes; ++k) total += double{sums[k]};
    for (; i < end; ++i) total += double{a[i]} * double{b[i]};
  }
  return total;
}

/// The filter of output `out` on input `in`: normal numbers that keep the variance of white noise.
cv::Mat1f random_filter(int layer, int out, int in, int inputs, int side) {
  Random random = Random(filter_seed).stream(static_cast<std::uint64_t>(layer));
  random = random.stream(static_cast<std::uint64_t>(out * inputs + in));
  cv::Mat1f filter(side, side);
  const float scale = 1 / std::sqrt(static_cast<float>(inputs * side * side));
  for (float& value : filter) value = random.normal() * scale;
  if (layer == 1) filter -= cv::mean(filter)[0];
  return filter;
}

std::vector<cv::Mat> convolved(const std::vector<cv::Mat>& inputs, int layer, int outputs,
                               int side) {
  std::vector<cv::Mat> result(static_cast<std::size_t>(outputs));
  parallel_for(outputs, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto out = static_cast<int>(begin); out < end; ++out) {
      // No expressions of matrices: OpenCV sets these up on first use, which the thread sanitizer
      // takes for a race.
      cv::Mat sum(inputs[0].size(), CV_32F, cv::Scalar(0)), term;
      for (std::size_t in = 0; in < inputs.size(); ++in) {
        if (inputs[in].empty()) continue;
        cv::filter2D(
            inputs[in], term, CV_32F,
            random_filter(layer, out, static_cast<int>(in), static_cast<int>(inputs.size()), side),
            {-1, -1}, 0, cv::BORDER_REFLECT_101);
        sum += term;
      }
      cv::Mat& made = result[static_cast<std::size_t>(out)];
      if (layer == 1)
        cv::absdiff(sum, cv::Scalar(0), made);
      else
        cv::threshold(sum, made, 0, 0, cv::THRESH_TOZERO);
    }
  });
  return result;
}

RandomFeatures::Scale moments_of(const std::vector<cv::Mat>& maps) {
  constexpr int count = RandomFeatures::count;
  const std::size_t pixels = maps[0].total();
  RandomFeatures::Scale scale{std::vector<double>(count), std::vector<double>(count * count)};
  parallel_for(count, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      scale.mean[i] = cv::mean(maps[i])[0];
      for (std::size_t j = 0; j <= i; ++j)
        scale.moment[i * count + j] = scale.moment[j * count + i] =
            dot(maps[i].ptr<float>(), maps[j].ptr<float>(), pixels) / static_cast<double>(pixels);
    }
  });
  return scale;
}

/// 1 / deviation of each feature. One that is nearly always 0 counts as a tenth of its layer's mean
/// variance, lest a single active pixel decide.
std::vector<double> units(const RandomFeatures::Scale& scale) {
  constexpr int count = RandomFeatures::count;
  std::vector<double> result;
  for (int i = 0; i < count; ++i)
    result.push_back(scale.moment[static_cast<std::size_t>(i * count + i)] -
                     scale.mean[static_cast<std::size_t>(i)] *
                         scale.mean[static_cast<std::size_t>(i)]);
  const auto raise = [&](int begin, int end) {
    const auto first = result.begin() + begin, last = result.begin() + end;
    const double least = std::max(1e-6, 0.1 * std::accumulate(first, last, 0.0) / (end - begin));
    for (auto v = first; v != last; ++v) *v = 1 / std::sqrt(std::max(*v, least));
  };
  raise(0, first_filters);
  raise(first_filters, count);
  return result;
}

}  // namespace

RandomFeatures random_features(const Image& components) {
  RandomFeatures features;
  Image image = components;
  while (static_cast<int>(features.scales.size()) < most_scales &&
         std::min(image.width, image.height) >= smallest_scale) {
    std::vector<cv::Mat> planes;
    for (int c = 0; c < image.channels; ++c) {
      planes.push_back(channel_plane(image, c));
      // A component that the picture doesn't have adds nothing.
      if (c > 0 && cv::countNonZero(planes.back()) == 0) planes.back().release();
    }
    std::vector<cv::Mat> maps = convolved(planes, 1, first_filters, 5);
    const std::vector<cv::Mat> second = convolved(maps, 2, second_filters, 3);
    maps.insert(maps.end(), second.begin(), second.end());
    features.scales.push_back(moments_of(maps));
    image = smoothly_halved(image);
  }
  return features;
}

double gram_distance(const RandomFeatures& exemplar, const RandomFeatures& image) {
  constexpr std::size_t count = RandomFeatures::count;
  const std::size_t scales = std::min(exemplar.scales.size(), image.scales.size());
  double total = 0;
  for (std::size_t s = 0; s < scales; ++s) {
    const auto &e = exemplar.scales[s], &x = image.scales[s];
    const std::vector<double> unit = units(e);
    double difference = 0, size = 1;  // the constant's own moment is 1
    for (std::size_t i = 0; i < count; ++i) {
      const double shift = (x.mean[i] - e.mean[i]) * unit[i];
      difference += 2 * shift * shift;
      for (std::size_t j = 0; j < count; ++j) {
        const double scale = unit[i] * unit[j];
        const double g_e = (e.moment[i * count + j] - e.mean[i] * e.mean[j]) * scale;
        const double g_x = (x.moment[i * count + j] - x.mean[i] * e.mean[j] -
                            e.mean[i] * x.mean[j] + e.mean[i] * e.mean[j]) *
                           scale;
        difference += (g_x - g_e) * (g_x - g_e);
        size += g_e * g_e;
      }
    }
    total += std::sqrt(difference / size);
  }
  return total / static_cast<double>(scales);
}

}  // namespace gramloom
