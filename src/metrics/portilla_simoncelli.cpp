#include "metrics/portilla_simoncelli.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/threads.h"

namespace gramloom {

namespace {

constexpr int most_lag = 3;

/// Deviations below a thousandth of the exemplar's are alike.
double log_deviation(double variance) { return 0.5 * std::log(variance + 1e-6); }

void add_shape(std::vector<double>& out, const cv::Mat& plane, const Moments& m) {
  double third = 0, fourth = 0;
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x) {
      const double d = double{plane.at<float>(y, x)} - m.mean;
      third += d * d * d;
      fourth += d * d * d * d;
    }
  const auto n = static_cast<double>(plane.total());
  const double variance = std::max(m.variance, 1e-6);
  const double skewness = third / n / std::pow(variance, 1.5);
  out.push_back(skewness / (1 + std::abs(skewness)));
  out.push_back(std::log1p(fourth / n / (variance * variance)));
}

void add_lags(std::vector<double>& out, const cv::Mat& plane) {
  const Moments m = moments(plane);
  for (int dy = 0; dy <= most_lag; ++dy)
    for (int dx = dy == 0 ? 1 : -most_lag; dx <= most_lag; ++dx)
      out.push_back(lag_correlation(plane, m, dx, dy));
}

/// Correlation of a complex band with the coarser one's, whose phase turns half as fast and is
/// doubled: an edge has one phase at all scales, which random phases don't.
void add_phase_correlation(std::vector<double>& out, const Bands& bands, std::size_t fine,
                           std::size_t coarse) {
  const cv::Mat& magnitude = bands.magnitude[coarse];
  double fine_energy = 0, coarse_energy = 0, real = 0, imaginary = 0;
  for (int y = 0; y < magnitude.rows; ++y)
    for (int x = 0; x < magnitude.cols; ++x) {
      const double a = bands.even[fine].at<float>(2 * y, 2 * x);
      const double b = bands.odd[fine].at<float>(2 * y, 2 * x);
      const double size = magnitude.at<float>(y, x);
      if (size <= 0) continue;
      const double c = bands.even[coarse].at<float>(y, x) / size;
      const double d = bands.odd[coarse].at<float>(y, x) / size;
      const double doubled_c = (c * c - d * d) * size, doubled_d = 2 * c * d * size;
      fine_energy += a * a + b * b;
      coarse_energy += size * size;
      real += a * doubled_c + b * doubled_d;
      imaginary += b * doubled_c - a * doubled_d;
    }
  const double scale = std::sqrt(fine_energy * coarse_energy);
  const bool flat = scale < 1e-10 * static_cast<double>(magnitude.total());
  out.push_back(flat ? 0 : real / scale);
  out.push_back(flat ? 0 : imaginary / scale);
}

void add_pairs(TextureStatistics& s, const Bands& bands) {
  for (int level = 0; level < bands.levels; ++level)
    for (int q = 0; q < Bands::orientations; ++q) {
      const std::size_t band = Bands::index(level, q);
      for (int other = q + 1; other < Bands::orientations; ++other)
        s.magnitude_pairs.push_back(
            correlation(bands.magnitude[band], bands.magnitude[Bands::index(level, other)]));
      if (level + 1 == bands.levels) continue;
      for (int other = 0; other < Bands::orientations; ++other)
        s.magnitude_pairs.push_back(
            correlation(bands.magnitude[band], bands.magnitude[Bands::index(level + 1, other)]));
      add_phase_correlation(s.phases, bands, band, Bands::index(level + 1, q));
    }
}

double root_mean_square(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

TextureStatistics texture_statistics(const cv::Mat& plane, const Bands& bands) {
  TextureStatistics s;
  const Moments m = moments(plane);
  s.marginals = {m.mean, log_deviation(m.variance)};
  cv::Mat low = plane;
  for (int level = 0; level <= bands.levels; ++level) {
    add_shape(s.marginals, low, moments(low));
    add_lags(s.low_pass_lags, low);
    cv::Mat half;
    cv::pyrDown(low, half);
    low = half;
  }
  s.energies = {log_deviation(moments(bands.high).variance),
                log_deviation(moments(bands.low).variance)};
  for (const cv::Mat& band : bands.odd) s.energies.push_back(log_deviation(moments(band).variance));
  std::vector<std::vector<double>> lags(bands.magnitude.size());
  parallel_for(
      static_cast<std::int64_t>(lags.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
          add_lags(lags[i], bands.magnitude[i]);
      });
  for (const auto& of_band : lags)
    s.magnitude_lags.insert(s.magnitude_lags.end(), of_band.begin(), of_band.end());
  add_pairs(s, bands);
  return s;
}

double statistics_distance(const TextureStatistics& a, const TextureStatistics& b) {
  return (root_mean_square(a.marginals, b.marginals) + root_mean_square(a.energies, b.energies) +
          root_mean_square(a.low_pass_lags, b.low_pass_lags) +
          root_mean_square(a.magnitude_lags, b.magnitude_lags) +
          root_mean_square(a.magnitude_pairs, b.magnitude_pairs) +
          root_mean_square(a.phases, b.phases)) /
         6;
}

}  // namespace gramloom
