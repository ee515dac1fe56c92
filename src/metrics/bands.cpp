#include "metrics/bands.h"

#include <algorithm>
#include <cmath>

#include "core/threads.h"
#include "signal/fourier.h"
#include "signal/steerable_pyramid.h"

namespace gramloom {

namespace {

/// Variances below this share of the exemplar's count as none: rounding alone makes them.
constexpr double flat_variance = 1e-10;

/// The largest length up to `length` that 2ᴸ divides and whose grids are all fast.
int whole_length(int length, int levels) {
  const int step = 1 << levels;
  int samples = length / step;
  while (samples > 1 && fast_length_up(samples) != samples) --samples;
  return samples * step;
}

}  // namespace

int common_levels(Size a, Size b) {
  const int side = std::min(std::min(a.width, a.height), std::min(b.width, b.height));
  int levels = 2;
  while (levels < 4 && side >> (levels + 1) >= 4) ++levels;
  return levels;
}

Bands bands_of(const cv::Mat& plane, int levels) {
  const Size size{whole_length(plane.cols, levels), whole_length(plane.rows, levels)};
  const cv::Mat coefficients =
      periodic_coefficients(plane({0, 0, size.width, size.height}).clone());
  const SteerablePyramid pyramid = steerable_pyramid(size, levels, Bands::orientations);
  Bands bands;
  bands.levels = levels;
  const std::size_t count = Bands::index(levels, 0);
  bands.odd.resize(count);
  bands.even.resize(count);
  bands.magnitude.resize(count);
  bands.high = band_of(coefficients, pyramid.bands.front());
  bands.low = band_of(coefficients, pyramid.bands.back());
  parallel_for(static_cast<std::int64_t>(count), 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      PyramidBand band = pyramid.bands[i + 1];
      bands.odd[i] = band_of(coefficients, band);
      band.gain = cv::abs(band.gain);  // cos³ is odd, |cos³| even: the other half of the pair
      band.phase = 1;
      bands.even[i] = band_of(coefficients, band);
      cv::magnitude(bands.odd[i], bands.even[i], bands.magnitude[i]);
    }
  });
  return bands;
}

double correlation(const cv::Mat& a, const cv::Mat& b) {
  const int step = a.cols / b.cols;
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = 0; y < b.rows; ++y) {
    const auto *in_a = a.ptr<float>(y * step), *in_b = b.ptr<float>(y);
    for (int x = 0; x < b.cols; ++x) {
      const double u = in_a[x * step], v = in_b[x];
      sum_a += u;
      sum_b += v;
      aa += u * u;
      bb += v * v;
      ab += u * v;
    }
  }
  const auto n = static_cast<double>(b.total());
  const double variance_a = aa / n - sum_a * sum_a / (n * n);
  const double variance_b = bb / n - sum_b * sum_b / (n * n);
  if (variance_a < flat_variance || variance_b < flat_variance) return 0;
  const double covariance = ab / n - sum_a * sum_b / (n * n);
  return std::clamp(covariance / std::sqrt(variance_a * variance_b), -1.0, 1.0);
}

Moments moments(const cv::Mat& plane) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(plane, mean, deviation);
  return {mean[0], deviation[0] * deviation[0]};
}

double lag_correlation(const cv::Mat& plane, const Moments& of_plane, int dx, int dy) {
  const int width = plane.cols - std::abs(dx), height = plane.rows - dy;
  if (of_plane.variance < flat_variance || width <= 0 || height <= 0) return 0;
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    const float* a = plane.ptr<float>(y) + std::max(0, -dx);
    const float* b = plane.ptr<float>(y + dy) + std::max(0, dx);
    for (int x = 0; x < width; ++x)
      sum += (double{a[x]} - of_plane.mean) * (double{b[x]} - of_plane.mean);
  }
  return std::clamp(sum / (double(width) * height) / of_plane.variance, -1.0, 1.0);
}

}  // namespace gramloom
