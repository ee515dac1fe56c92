#include "metrics/stsim.h"

#include <cmath>

namespace gramloom {

namespace {

/// Keeps terms of nearly empty bands apart from 0/0; in the exemplar's variance.
constexpr double small = 1e-4;

constexpr std::size_t low_pass = 1;  // among StsimStatistics::bands

double likeness(double x, double y) { return (2 * x * y + small) / (x * x + y * y + small); }

StsimStatistics::Band band_statistics(const cv::Mat& band) {
  const Moments m = moments(band);
  return {m.mean, std::sqrt(m.variance), lag_correlation(band, m, 0, 1),
          lag_correlation(band, m, 1, 0)};
}

double lag_term(double x, double y) { return 1 - std::abs(x - y) / 2; }

/// (l c c₀₁ c₁₀)^¼ of a band whose mean lies `offset` above that of its samples.
double band_term(const StsimStatistics::Band& e, const StsimStatistics::Band& i, double offset) {
  const double l = likeness(std::abs(e.mean + offset), std::abs(i.mean + offset));
  const double c = likeness(e.deviation, i.deviation);
  return std::sqrt(std::sqrt(l * c * lag_term(e.down, i.down) * lag_term(e.right, i.right)));
}

}  // namespace

StsimStatistics stsim_statistics(const Bands& bands) {
  StsimStatistics s;
  s.bands = {band_statistics(bands.high), band_statistics(bands.low)};
  const auto pair = [&](std::size_t a, std::size_t b) {
    s.pairs.push_back(correlation(bands.magnitude[a], bands.magnitude[b]));
  };
  for (int level = 0; level < bands.levels; ++level)
    for (int q = 0; q < Bands::orientations; ++q) {
      const std::size_t band = Bands::index(level, q);
      s.bands.push_back(band_statistics(bands.odd[band]));
      for (int other = q + 1; other < Bands::orientations; ++other)
        pair(band, Bands::index(level, other));
      if (level + 1 < bands.levels) pair(band, Bands::index(level + 1, q));
    }
  return s;
}

double stsim2(const StsimStatistics& exemplar, const StsimStatistics& image) {
  double sum = 0;
  for (std::size_t i = 0; i < exemplar.bands.size(); ++i)
    sum += band_term(exemplar.bands[i], image.bands[i], i == low_pass ? stsim_mean : 0);
  for (std::size_t i = 0; i < exemplar.pairs.size(); ++i)
    sum += lag_term(exemplar.pairs[i], image.pairs[i]);
  return sum / static_cast<double>(exemplar.bands.size() + exemplar.pairs.size());
}

}  // namespace gramloom
