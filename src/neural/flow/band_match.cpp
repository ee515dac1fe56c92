#include "neural/flow/band_match.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "neural/guidance.h"
#include "signal/blur.h"

namespace gramloom::neural {

namespace {

constexpr std::array blurs{1.0, 2.0, 4.0, 8.0};

// Calls f(band) with each band from the finest on, then rest(what remains).
template <class Band, class Rest>
void for_each_band(const Image& image, Tile wraps, std::size_t bands, Band&& f, Rest&& rest) {
  Image remaining = image;
  for (std::size_t i = 0; i < bands; ++i) {
    Image smooth = blurred(remaining, blurs[i], wraps);
    for (std::size_t k = 0; k < smooth.pixels.size(); ++k) remaining.pixels[k] -= smooth.pixels[k];
    f(remaining);
    remaining = std::move(smooth);
  }
  rest(remaining);
}

std::size_t bands_of(Size size) {
  std::size_t bands = 0;
  while (bands < blurs.size() && 4 * blurs[bands] <= std::min(size.width, size.height)) ++bands;
  return bands;
}

struct Moments {
  std::vector<float> mean, deviation;
};

Moments moments(const Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<double> sum(channels), squares(channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) sum[i % channels] += image.pixels[i];
  const double pixels = static_cast<double>(image.pixels.size() / channels);
  for (double& s : sum) s /= pixels;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double d = image.pixels[i] - sum[i % channels];
    squares[i % channels] += d * d;
  }
  Moments m;
  for (std::size_t c = 0; c < channels; ++c) {
    m.mean.push_back(static_cast<float>(sum[c]));
    m.deviation.push_back(static_cast<float>(std::sqrt(squares[c] / pixels)));
  }
  return m;
}

std::vector<float> factors(const std::vector<float>& goal, const std::vector<float>& own) {
  std::vector<float> result;
  for (std::size_t c = 0; c < goal.size(); ++c)
    result.push_back(std::clamp(goal[c] / std::max(own[c], 1e-6f), 0.5f, 3.0f));
  return result;
}

}  // namespace

BandStatistics band_statistics(const Image& image, Tile wraps, Size picture, const Image& usable) {
  const auto moments_of = [&](const Image& band) {
    return usable.empty() ? moments(band) : moments(usable_pixels(band, usable));
  };
  BandStatistics statistics;
  for_each_band(
      image, wraps, std::min(bands_of(image.size()), bands_of(picture)),
      [&](const Image& band) { statistics.deviation.push_back(moments_of(band).deviation); },
      [&](const Image& rest) {
        const Moments m = moments_of(rest);
        statistics.deviation.push_back(m.deviation);
        statistics.mean = m.mean;
      });
  return statistics;
}

void match_bands(Image& image, const BandStatistics& exemplar) {
  const std::size_t bands = std::min(exemplar.deviation.size() - 1, bands_of(image.size()));
  const auto channels = static_cast<std::size_t>(image.channels);
  Image result(image.size(), image.channels);
  std::size_t band = 0;
  for_each_band(
      image, Tile::both, bands,
      [&](const Image& part) {
        const auto factor = factors(exemplar.deviation[band++], moments(part).deviation);
        for (std::size_t i = 0; i < part.pixels.size(); ++i)
          result.pixels[i] += part.pixels[i] * factor[i % channels];
      },
      [&](const Image& rest) {
        const Moments m = moments(rest);
        const auto factor = factors(exemplar.deviation.back(), m.deviation);
        for (std::size_t i = 0; i < rest.pixels.size(); ++i) {
          const std::size_t c = i % channels;
          result.pixels[i] += (rest.pixels[i] - m.mean[c]) * factor[c] + exemplar.mean[c];
        }
      });
  image = std::move(result);
}

void match_bands(Image& image, const BandStatistics& exemplar, const Image& made) {
  const std::size_t bands = std::min(exemplar.deviation.size() - 1, bands_of(image.size()));
  const auto channels = static_cast<std::size_t>(image.channels);
  Image result(image.size(), image.channels);
  std::size_t band = 0;
  for_each_band(
      image, Tile::both, bands,
      [&](const Image& part) {
        const auto factor =
            factors(exemplar.deviation[band++], moments(usable_pixels(part, made)).deviation);
        for (std::size_t i = 0; i < part.pixels.size(); ++i)
          result.pixels[i] += part.pixels[i] * factor[i % channels];
      },
      [&](const Image& rest) {
        for (std::size_t i = 0; i < rest.pixels.size(); ++i) result.pixels[i] += rest.pixels[i];
      });
  image = std::move(result);
}

}  // namespace gramloom::neural
