#include "signal/random_phase.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/threads.h"
#include "signal/fourier.h"
#include "signal/window.h"

namespace gramloom {

namespace {

/// Unit numbers exp(iθ), θ uniform, for columns 0 to width/2 of a spectrum. A real image asks for
/// θ(−k) = −θ(k), which within these columns concerns the two that mirror themselves; where k and
/// −k coincide only the sign is free, and the mean keeps its own.
cv::Mat random_phases(Size size, Random random) {
  const int columns = size.width / 2 + 1;
  cv::Mat phases(size.height, columns, CV_32FC2);
  parallel_for(size.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < end; ++y) {
      Random row = random.stream(static_cast<std::uint64_t>(y));
      for (int x = 0; x < columns; ++x)
        phases.at<Complex>(y, x) = std::polar(1.0f, row.uniform() * 2 * std::numbers::pi_v<float>);
    }
  });
  const auto mirror = [&](int x) {
    for (int y = 0; y < size.height; ++y) {
      const int opposite = (size.height - y) % size.height;
      auto& phase = phases.at<Complex>(y, x);
      if (opposite < y)
        phase = std::conj(phases.at<Complex>(opposite, x));
      else if (opposite == y)
        phase = phase.real() < 0 ? -1.0f : 1.0f;
    }
  };
  mirror(0);
  if (size.width % 2 == 0) mirror(size.width / 2);
  phases.at<Complex>(0, 0) = 1;
  return phases;
}

/// Multiplies a spectrum by a random phase at each frequency.
void add_phases(cv::Mat& coefficients, const cv::Mat& phases) {
  for (int y = 0; y < phases.rows; ++y) {
    auto* out = coefficients.ptr<Complex>(y);
    const auto* phase = phases.ptr<Complex>(y);
    for (int x = 0; x < phases.cols; ++x) out[x] = times(out[x], phase[x]);
  }
}

/// The weights of an axis of the spot: 1 where the period is no longer than the exemplar, else
/// fading at both ends; scaled so that a spot keeps the exemplar's variance over the period.
std::vector<float> spot_weights(int exemplar, int period, double fade) {
  return scaled_to_energy(raised_cosine(exemplar, period > exemplar ? fade : 0), period);
}

/// Spectrum of the spot: the periodic component, less its mean, weighted, and laid into the period,
/// around which it wraps if it is longer. The mean is put back at frequency 0.
cv::Mat spot_coefficients(const cv::Mat& plane, Size period, double fade) {
  cv::Mat periodic = periodic_coefficients(plane);
  if (period == Size{plane.cols, plane.rows}) return periodic;
  const Complex mean = periodic.at<Complex>(0, 0);
  periodic.at<Complex>(0, 0) = 0;
  const cv::Mat centred = from_fourier_coefficients(periodic);
  const auto weight_x = spot_weights(plane.cols, period.width, fade);
  const auto weight_y = spot_weights(plane.rows, period.height, fade);
  cv::Mat spot = cv::Mat::zeros(period.height, period.width, CV_32F);
  for (int y = 0; y < centred.rows; ++y)
    for (int x = 0; x < centred.cols; ++x)
      spot.at<float>(y % period.height, x % period.width) += centred.at<float>(y, x) *
                                                             weight_x[static_cast<std::size_t>(x)] *
                                                             weight_y[static_cast<std::size_t>(y)];
  cv::Mat coefficients = fourier_coefficients(spot);
  coefficients.at<Complex>(0, 0) = mean;
  return coefficients;
}

/// body(channel) in parallel.
void for_each_channel(const Image& image, const std::function<void(int)>& body) {
  parallel_for(image.channels, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<int>(begin); c < end; ++c) body(c);
  });
}

}  // namespace

Image random_phase_texture(const Image& exemplar, Size size, Tile tile, double fade,
                           Random random) {
  const Size period{period_for(exemplar.width, size.width, tiles_x(tile)),
                    period_for(exemplar.height, size.height, tiles_y(tile))};
  const cv::Mat phases = random_phases(period, random);
  Image result(size, exemplar.channels);
  for_each_channel(result, [&](int c) {
    cv::Mat coefficients = spot_coefficients(channel_plane(exemplar, c), period, fade);
    add_phases(coefficients, phases);
    set_channel(result, c, from_fourier_coefficients(coefficients));
  });
  clamp_to(result, channel_range(exemplar));
  return result;
}

Image periodic_component(const Image& image) {
  Image result(image.size(), image.channels);
  for_each_channel(result, [&](int c) {
    set_channel(result, c,
                from_fourier_coefficients(periodic_coefficients(channel_plane(image, c))));
  });
  return result;
}

Image random_phase_noise(const Image& spot, Random random) {
  const cv::Mat phases = random_phases(spot.size(), random);
  Image result(spot.size(), spot.channels);
  for_each_channel(result, [&](int c) {
    cv::Mat coefficients = fourier_coefficients(channel_plane(spot, c));
    add_phases(coefficients, phases);
    set_channel(result, c, from_fourier_coefficients(coefficients));
  });
  return result;
}

}  // namespace gramloom
