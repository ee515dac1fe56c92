#include "metrics/stsim.h"

#include <cmath>

namespace gramloom {

namespace {

/// Keeps terms of nearly empty bands apart from 0/0; in the exemplar's variance.
constexpr double small = 1e-4;

double likeness(double x, double y) { return (2 * x * y + small) / (x * x + y * y + small); }

/// (l c c₀₁ c₁₀)^¼ of a band whose mean lies `offset` above that of its samples.
double band_term(const cv::Mat& exemplar, const cv::Mat& image, double offset) {
  const Moments e = moments(exemplar), i = moments(image);
  const double l = likeness(std::abs(e.mean + offset), std::abs(i.mean + offset));
  const double c = likeness(std::sqrt(e.variance), std::sqrt(i.variance));
  const auto lag_term = [&](int dx, int dy) {
    return 1 -
           std::abs(lag_correlation(exemplar, e, dx, dy) - lag_correlation(image, i, dx, dy)) / 2;
  };
  return std::sqrt(std::sqrt(l * c * lag_term(0, 1) * lag_term(1, 0)));
}

}  // namespace

double stsim2(const Bands& exemplar, const Bands& image) {
  double sum =
      band_term(exemplar.high, image.high, 0) + band_term(exemplar.low, image.low, stsim_mean);
  int terms = 2;
  const auto pair = [&](std::size_t a, std::size_t b) {
    sum += 1 - std::abs(correlation(exemplar.magnitude[a], exemplar.magnitude[b]) -
                        correlation(image.magnitude[a], image.magnitude[b])) /
                   2;
    ++terms;
  };
  for (int level = 0; level < exemplar.levels; ++level)
    for (int q = 0; q < Bands::orientations; ++q) {
      const std::size_t band = Bands::index(level, q);
      sum += band_term(exemplar.odd[band], image.odd[band], 0);
      ++terms;
      for (int other = q + 1; other < Bands::orientations; ++other)
        pair(band, Bands::index(level, other));
      if (level + 1 < exemplar.levels) pair(band, Bands::index(level + 1, q));
    }
  return sum / terms;
}

}  // namespace gramloom
