#include "train/colour_axes.h"

#include <algorithm>
#include <cmath>

#include "signal/layer_axes.h"

namespace gramloom {

namespace {

// The pixels of all, one below the other.
Image all_pixels(const std::vector<Image>& images) {
  std::size_t count = 0;
  for (const Image& image : images) count += image.pixels.size();
  const int channels = images.front().channels;
  Image all(1, static_cast<int>(count / static_cast<std::size_t>(channels)), channels);
  auto to = all.pixels.begin();
  for (const Image& image : images) to = std::copy(image.pixels.begin(), image.pixels.end(), to);
  return all;
}

}  // namespace

ColourAxes colour_axes(const std::vector<Image>& exemplars, const std::vector<Layer>& layers,
                       double whitening) {
  const Image pixels = all_pixels(exemplars);
  const auto blocks = channel_blocks(layers, pixels.channels);
  const ColourPca pca = principal_axes(pixels, blocks);
  const auto channels = static_cast<std::size_t>(pixels.channels);
  ColourAxes result{pixels.channels, pca.mean, std::vector<float>(channels * channels),
                    std::vector<float>(channels * channels)};
  for (const ChannelBlock& block : blocks) {
    double largest = 0;
    const auto first = static_cast<std::size_t>(block.first);
    const auto end = first + static_cast<std::size_t>(block.count);
    for (std::size_t i = first; i < end; ++i) largest = std::max<double>(largest, pca.deviation[i]);
    for (std::size_t i = first; i < end; ++i) {
      // A flat axis is not made loud, and a flat layer stays as it is.
      const double share = largest > 0 ? std::max(0.02, pca.deviation[i] / largest) : 1;
      const double scale = std::pow(share, -whitening) / (largest > 0 ? largest : 1);
      for (std::size_t c = 0; c < channels; ++c) {
        const float axis = pca.axes[i * channels + c];
        result.to_axes[i * channels + c] = static_cast<float>(axis * scale);
        result.axes[c * channels + i] = static_cast<float>(axis / scale);
      }
    }
  }
  return result;
}

}  // namespace gramloom
