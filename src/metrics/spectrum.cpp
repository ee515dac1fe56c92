#include "metrics/spectrum.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "classic/fourier.h"
#include "core/threads.h"

namespace gramloom {

namespace {

struct Rings {
  double lowest;  // cycles a pixel
  int count;      // equal ratios from `lowest` to ½
  int ring(double frequency) const {
    return static_cast<int>(
        std::floor(count * std::log(frequency / lowest) / std::log(0.5 / lowest)));
  }
};

/// Mean power of white noise's coefficient is then its variance, at any size.
std::vector<double> ring_densities(const Image& image, const Rings& rings) {
  const auto bins = static_cast<std::size_t>(rings.count);
  std::vector<std::vector<double>> power(static_cast<std::size_t>(image.channels),
                                         std::vector<double>(bins));
  std::vector<double> samples(bins);
  parallel_for(image.channels, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<int>(begin); c < end; ++c) {
      const cv::Mat coefficients = periodic_coefficients(channel_plane(image, c));
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x <= image.width / 2; ++x) {
          const double u = static_cast<double>(x) / image.width;
          const double v = static_cast<double>(std::min(y, image.height - y)) / image.height;
          const double frequency = std::sqrt(u * u + v * v);
          if (frequency < rings.lowest || frequency > 0.5) continue;
          const auto ring =
              static_cast<std::size_t>(std::min(rings.ring(frequency), rings.count - 1));
          power[static_cast<std::size_t>(c)][ring] +=
              static_cast<double>(std::norm(coefficients.at<Complex>(y, x)));
          if (c == 0) samples[ring] += 1;
        }
    }
  });
  std::vector<double> density(bins);
  for (std::size_t r = 0; r < bins; ++r)
    for (const auto& of_channel : power)
      if (samples[r] > 0)
        density[r] += of_channel[r] / samples[r] * image.width * image.height;
      else
        density[r] = -1;
  return density;
}

}  // namespace

double spectrum_distance(const Image& exemplar, const Image& image) {
  const int side =
      std::min(std::min(exemplar.width, exemplar.height), std::min(image.width, image.height));
  const double lowest = 2.0 / side;
  const Rings rings{lowest, std::max(2, static_cast<int>(std::ceil(3 * std::log2(0.5 / lowest))))};
  const auto e = ring_densities(exemplar, rings), x = ring_densities(image, rings);
  constexpr double floor = 1e-6;  // of the exemplar's variance, which is 1
  double sum = 0;
  int used = 0;
  for (std::size_t r = 0; r < e.size(); ++r) {
    if (e[r] < 0 || x[r] < 0) continue;  // no frequency of a small image lies in this ring
    const double difference = 10 * std::log10((x[r] + floor) / (e[r] + floor));
    sum += difference * difference;
    ++used;
  }
  return used > 0 ? std::sqrt(sum / used) : 0;
}

}  // namespace gramloom
