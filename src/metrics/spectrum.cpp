#include "metrics/spectrum.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/threads.h"
#include "signal/fourier.h"
#include "signal/window.h"

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

/// Hann's window, scaled to a mean square of 1.
std::vector<float> hann_window(int length) {
  return scaled_to_energy(raised_cosine(length, 0.5), length);
}

/// A channel less its mean, faded out towards its edges.
cv::Mat faded_plane(const Image& image, int channel, const std::vector<float>& window_x,
                    const std::vector<float>& window_y) {
  cv::Mat plane = channel_plane(image, channel);
  plane -= cv::mean(plane)[0];
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x)
      plane.at<float>(y, x) *=
          window_x[static_cast<std::size_t>(x)] * window_y[static_cast<std::size_t>(y)];
  return plane;
}

/// The ring of each coefficient, −1 outside of all: of columns 0 to W/2 and rows 0 to H/2, the
/// others mirror them.
cv::Mat1i rings_of(Size size, const Rings& rings) {
  cv::Mat1i result(size.height / 2 + 1, size.width / 2 + 1, -1);
  parallel_for(result.rows, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < result.cols; ++x) {
        const double u = static_cast<double>(x) / size.width;
        const double v = static_cast<double>(y) / size.height;
        const double frequency = std::sqrt(u * u + v * v);
        if (frequency < rings.lowest || frequency > 0.5) continue;
        result(y, x) = std::min(rings.ring(frequency), rings.count - 1);
      }
  });
  return result;
}

}  // namespace

/// White noise's density is its variance, at any size.
std::vector<double> ring_densities(const Image& image, int side) {
  const double lowest = 4.0 / side;  // fewer periods: too few coefficients for an estimate
  const Rings rings{lowest, std::max(2, static_cast<int>(std::ceil(2 * std::log2(0.5 / lowest))))};
  const cv::Mat1i ring_at = rings_of(image.size(), rings);
  const auto bins = static_cast<std::size_t>(rings.count);
  std::vector<std::vector<double>> power(static_cast<std::size_t>(image.channels),
                                         std::vector<double>(bins));
  std::vector<double> samples(bins);
  const auto window_x = hann_window(image.width), window_y = hann_window(image.height);
  parallel_for(image.channels, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<int>(begin); c < end; ++c) {
      const cv::Mat coefficients = fourier_coefficients(faded_plane(image, c, window_x, window_y));
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x <= image.width / 2; ++x) {
          const int at = ring_at(std::min(y, image.height - y), x);
          if (at < 0) continue;
          const auto ring = static_cast<std::size_t>(at);
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

double spectrum_distance(const std::vector<double>& e, const std::vector<double>& x) {
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
