#include "signal/random_phase.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/threads.h"
#include "signal/fourier.h"
#include "signal/united.h"
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

double usable_count(const Exemplar& exemplar) {
  if (exemplar.mask.empty()) return 1.0 * exemplar.image.width * exemplar.image.height;
  return static_cast<double>(
      std::ranges::count_if(exemplar.mask.pixels, [](float m) { return m > 0.5f; }));
}

/// Spectrum of the spot of a masked exemplar: its usable pixels less their mean among zeros, scaled
/// so that it keeps their variance over the period; the mean at frequency 0.
cv::Mat masked_spot_coefficients(const Exemplar& exemplar, int channel, Size period) {
  const Image &image = exemplar.image, &mask = exemplar.mask;
  const double count = usable_count(exemplar);
  double mean = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (*mask.at(x, y) > 0.5f) mean += double{image.at(x, y)[channel]} / count;
  const double scale = std::sqrt(1.0 * period.width * period.height / count);
  cv::Mat spot = cv::Mat::zeros(period.height, period.width, CV_32F);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (*mask.at(x, y) > 0.5f)
        spot.at<float>(y % period.height, x % period.width) +=
            static_cast<float>((double{image.at(x, y)[channel]} - mean) * scale);
  cv::Mat coefficients = fourier_coefficients(spot);
  coefficients.at<Complex>(0, 0) = static_cast<float>(mean);
  return coefficients;
}

/// Smallest and largest usable value of each channel.
ChannelRange usable_range(const std::vector<Exemplar>& exemplars) {
  ChannelRange range;
  for (const Exemplar& exemplar : exemplars) {
    const ChannelRange own = channel_range(
        exemplar.mask.empty() ? exemplar.image : extended(exemplar.image, exemplar.mask));
    if (range.low.empty()) range = own;
    for (std::size_t c = 0; c < own.low.size(); ++c) {
      range.low[c] = std::min(range.low[c], own.low[c]);
      range.high[c] = std::max(range.high[c], own.high[c]);
    }
  }
  return range;
}

/// The share of an exemplar at each pixel.
class Shares {
 public:
  Shares(const std::vector<Exemplar>& exemplars, const Image& weights) : weights_(weights) {
    double all = 0;
    for (const Exemplar& exemplar : exemplars) all += usable_count(exemplar);
    for (const Exemplar& exemplar : exemplars)
      usable_.push_back(static_cast<float>(usable_count(exemplar) / all));
  }
  float at(std::size_t exemplar, int x, int y) const {
    if (weights_.empty()) return usable_[exemplar];
    const float* weights = map_at(weights_, x, y);
    float sum = 0;
    for (std::size_t i = 0; i < usable_.size(); ++i) sum += weights[i];
    return weights[exemplar] / sum;
  }

 private:
  const Image& weights_;
  std::vector<float> usable_;
};

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

Image random_phase_texture(const std::vector<Exemplar>& exemplars, const Image& weights, Size size,
                           Tile tile, double fade, Random random) {
  if (exemplars.size() == 1 && exemplars.front().mask.empty())
    return random_phase_texture(exemplars.front().image, size, tile, fade, random);
  Size period{1, 1};
  for (const Exemplar& exemplar : exemplars)
    period = {
        std::max(period.width, period_for(exemplar.image.width, size.width, tiles_x(tile))),
        std::max(period.height, period_for(exemplar.image.height, size.height, tiles_y(tile)))};
  const Shares shares(exemplars, weights);
  Image result(size, exemplars.front().image.channels);
  for (std::size_t i = 0; i < exemplars.size(); ++i) {
    const Exemplar& exemplar = exemplars[i];
    const cv::Mat phases = random_phases(period, random.stream(i));
    for_each_channel(result, [&](int c) {
      cv::Mat coefficients = exemplar.mask.empty()
                                 ? spot_coefficients(channel_plane(exemplar.image, c), period, fade)
                                 : masked_spot_coefficients(exemplar, c, period);
      const float mean = coefficients.at<Complex>(0, 0).real();
      coefficients.at<Complex>(0, 0) = 0;
      add_phases(coefficients, phases);
      const cv::Mat noise = from_fourier_coefficients(coefficients);
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
          const float share = shares.at(i, x, y);
          result.at(x, y)[c] += share * mean + std::sqrt(share) * noise.at<float>(y, x);
        }
    });
  }
  clamp_to(result, usable_range(exemplars));
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
