#include "neural/flow/band_match.h"

#include <algorithm>
#include <array>
#include <cmath>

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

struct BandMoments {
  std::vector<float> mean, deviation;
  std::int64_t pixels = 0;
};

// Of each region.
std::vector<BandMoments> band_moments(const Image& image, const Regions& regions) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const auto count = static_cast<std::size_t>(regions.count);
  std::vector<double> sum(channels * count), squares(channels * count);
  std::vector<std::int64_t> pixels(count);
  // Calls f(value, its place in the sums) for all values of regions.
  const auto for_each_value = [&](auto&& f) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const std::int32_t region = regions.region.empty() ? 0 : regions.region[i / channels];
      if (region >= 0)
        f(image.pixels[i], static_cast<std::size_t>(region) * channels + i % channels);
    }
  };
  for_each_value([&](float value, std::size_t to) {
    sum[to] += value;
    if (to % channels == 0) ++pixels[to / channels];
  });
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] /= static_cast<double>(std::max<std::int64_t>(1, pixels[i / channels]));
  for_each_value([&](float value, std::size_t to) {
    const double d = value - sum[to];
    squares[to] += d * d;
  });
  std::vector<BandMoments> result(count);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    BandMoments& m = result[i / channels];
    m.pixels = pixels[i / channels];
    m.mean.push_back(static_cast<float>(sum[i]));
    m.deviation.push_back(static_cast<float>(
        std::sqrt(squares[i] / static_cast<double>(std::max<std::int64_t>(1, m.pixels)))));
  }
  return result;
}

std::vector<float> factors(const std::vector<float>& goal, const std::vector<float>& own) {
  std::vector<float> result;
  for (std::size_t c = 0; c < goal.size(); ++c)
    result.push_back(std::clamp(goal[c] / std::max(own[c], 1e-6f), 0.5f, 3.0f));
  return result;
}

}  // namespace

BandStatistics band_statistics(const Image& image, Tile wraps, Size picture) {
  return band_statistics(image, wraps, picture, {}).front();
}

std::vector<BandStatistics> band_statistics(const Image& image, Tile wraps, Size picture,
                                            const Regions& regions) {
  std::vector<BandStatistics> statistics(static_cast<std::size_t>(regions.count));
  for_each_band(
      image, wraps, std::min(bands_of(image.size()), bands_of(picture)),
      [&](const Image& band) {
        const auto of_regions = band_moments(band, regions);
        for (std::size_t r = 0; r < statistics.size(); ++r)
          statistics[r].deviation.push_back(of_regions[r].deviation);
      },
      [&](const Image& rest) {
        const auto of_regions = band_moments(rest, regions);
        for (std::size_t r = 0; r < statistics.size(); ++r) {
          statistics[r].deviation.push_back(of_regions[r].deviation);
          statistics[r].mean = of_regions[r].mean;
          statistics[r].pixels = of_regions[r].pixels;
        }
      });
  return statistics;
}

void match_bands(Image& image, const BandStatistics& exemplar) {
  match_bands(image, {exemplar}, {}, true);
}

void match_bands(Image& image, const std::vector<BandStatistics>& exemplar, const Regions& regions,
                 bool rest_too) {
  constexpr std::int64_t few = 64;
  const std::size_t bands = std::min(exemplar.front().deviation.size() - 1, bands_of(image.size()));
  const auto channels = static_cast<std::size_t>(image.channels);
  Image result(image.size(), image.channels);
  // Calls f(value to add to, the part's value, region, channel), or adds what is in no region.
  const auto add = [&](const Image& part, const std::vector<BandMoments>& own, auto&& f) {
    for (std::size_t i = 0; i < part.pixels.size(); ++i) {
      const std::int32_t region = regions.region.empty() ? 0 : regions.region[i / channels];
      const auto r = static_cast<std::size_t>(region);
      const bool matched = region >= 0 && (regions.region.empty() ||
                                           std::min(own[r].pixels, exemplar[r].pixels) >= few);
      if (matched)
        f(result.pixels[i], part.pixels[i], r, i % channels);
      else
        result.pixels[i] += part.pixels[i];
    }
  };
  // Those of the band for each region.
  const auto factors_of = [&](std::size_t band, const std::vector<BandMoments>& own) {
    std::vector<std::vector<float>> result_factors;
    for (std::size_t r = 0; r < own.size(); ++r)
      result_factors.push_back(factors(exemplar[r].deviation[band], own[r].deviation));
    return result_factors;
  };
  std::size_t band = 0;
  for_each_band(
      image, Tile::both, bands,
      [&](const Image& part) {
        const auto own = band_moments(part, regions);
        const auto factor = factors_of(band++, own);
        add(part, own, [&](float& to, float value, std::size_t r, std::size_t c) {
          to += value * factor[r][c];
        });
      },
      [&](const Image& rest) {
        const auto own = band_moments(rest, regions);
        const auto factor = factors_of(exemplar.front().deviation.size() - 1, own);
        add(rest, own, [&](float& to, float value, std::size_t r, std::size_t c) {
          to += rest_too ? (value - own[r].mean[c]) * factor[r][c] + exemplar[r].mean[c] : value;
        });
      });
  image = std::move(result);
}

}  // namespace gramloom::neural
