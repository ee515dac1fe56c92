#include "classic/pyramid_blend.h"

#include <algorithm>
#include <cmath>

#include "core/threads.h"

namespace gramloom {

namespace {

/// Means of a channel of each texture, and mean products of what differs from them.
struct Covariance {
  std::vector<double> mean, products;  // products: textures × textures
};

Covariance covariance_of(const std::vector<Image>& textures, int channel) {
  const std::size_t n = textures.size();
  const auto channels = static_cast<std::size_t>(textures.front().channels);
  Covariance result{std::vector<double>(n), std::vector<double>(n * n)};
  const std::size_t pixels = textures.front().pixels.size() / channels;
  const auto at = [&](std::size_t texture, std::size_t pixel) {
    return double{textures[texture].pixels[pixel * channels + static_cast<std::size_t>(channel)]};
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t p = 0; p < pixels; ++p)
      result.mean[i] += at(i, p) / static_cast<double>(pixels);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t p = 0; p < pixels; ++p)
        result.products[i * n + j] +=
            (at(i, p) - result.mean[i]) * (at(j, p) - result.mean[j]) / static_cast<double>(pixels);
  return result;
}

}  // namespace

Image blended_by_weights(const std::vector<Image>& textures, const Image& weights) {
  const std::size_t n = textures.size();
  Image result(textures.front().size(), textures.front().channels);
  ChannelRange range = channel_range(textures.front());
  for (const Image& texture : textures) {
    const ChannelRange own = channel_range(texture);
    for (std::size_t c = 0; c < own.low.size(); ++c) {
      range.low[c] = std::min(range.low[c], own.low[c]);
      range.high[c] = std::max(range.high[c], own.high[c]);
    }
  }
  parallel_for(result.channels, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<int>(begin); c < end; ++c) {
      const Covariance covariance = covariance_of(textures, c);
      std::vector<double> share(n);
      for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
          double sum = 0, mean = 0, value = 0, deviation = 0, variance = 0;
          for (std::size_t i = 0; i < n; ++i) sum += double{weights.at(x, y)[i]};
          std::size_t largest = 0;
          for (std::size_t i = 0; i < n; ++i) {
            share[i] = double{weights.at(x, y)[i]} / sum;
            if (share[i] > share[largest]) largest = i;
            mean += share[i] * covariance.mean[i];
            value += share[i] * double{textures[i].at(x, y)[c]};
            deviation += share[i] * std::sqrt(covariance.products[i * n + i]);
          }
          for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
              variance += share[i] * share[j] * covariance.products[i * n + j];
          const double scale =
              variance > 1e-6 * deviation * deviation ? deviation / std::sqrt(variance) : 1;
          // One alone is taken as it is: rounding would change it.
          const bool alone = weights.at(x, y)[largest] == static_cast<float>(sum);
          result.at(x, y)[c] = alone ? textures[largest].at(x, y)[c]
                                     : static_cast<float>(mean + scale * (value - mean));
        }
    }
  });
  clamp_to(result, range);
  return result;
}

}  // namespace gramloom
