#include "classic/palette.h"

#include <algorithm>
#include <limits>

#include "core/threads.h"
#include "signal/squared_distance.h"

namespace gramloom {

namespace {

constexpr std::size_t sample_size = 16384;
constexpr int rounds = 10;

std::size_t pixel_count(const Image& image) {
  return image.pixels.size() / static_cast<std::size_t>(image.channels);
}

/// All pixels, or as many random ones as suffice, as an image of one row.
Image sample(const Image& image, Random random) {
  const std::size_t pixels = pixel_count(image);
  const auto channels = static_cast<std::size_t>(image.channels);
  Image result(static_cast<int>(std::min(pixels, sample_size)), 1, image.channels);
  for (std::size_t i = 0; i < static_cast<std::size_t>(result.width); ++i) {
    const std::size_t from =
        pixels <= sample_size ? i : random.below(static_cast<std::uint32_t>(pixels));
    std::copy_n(image.pixels.data() + from * channels, channels,
                result.pixels.data() + i * channels);
  }
  return result;
}

/// k-means++: each colour is a pixel drawn in proportion to the square of its distance from the
/// colours so far; done early when every pixel is one of them.
Palette spread_out(const Image& pixels, int colours, Random random) {
  const auto channels = static_cast<std::size_t>(pixels.channels);
  std::vector<float> distance(pixel_count(pixels), 1.0f);
  Palette palette{pixels.channels, {}};
  for (int k = 0; k < colours; ++k) {
    double total = 0;
    for (const float d : distance) total += static_cast<double>(d);
    if (total <= 0) break;
    double left = total * static_cast<double>(random.uniform());
    std::size_t chosen = distance.size();
    for (std::size_t i = 0; i < distance.size() && (chosen == distance.size() || left >= 0); ++i) {
      if (distance[i] > 0) chosen = i;
      left -= static_cast<double>(distance[i]);
    }
    const float* colour = pixels.pixels.data() + chosen * channels;
    palette.colours.insert(palette.colours.end(), colour, colour + channels);
    for (std::size_t i = 0; i < distance.size(); ++i) {
      const float d = squared_distance(pixels.pixels.data() + i * channels, colour, channels);
      distance[i] = k == 0 ? d : std::min(distance[i], d);
    }
  }
  return palette;
}

/// Moves each colour to the mean of the pixels that are nearest to it.
void move_to_means(Palette& palette, const Image& pixels) {
  const auto channels = static_cast<std::size_t>(pixels.channels);
  const auto nearest = nearest_colours(pixels, palette);
  std::vector<double> sums(palette.colours.size());
  std::vector<double> counts(static_cast<std::size_t>(palette.size()));
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    counts[nearest[i]] += 1;
    for (std::size_t c = 0; c < channels; ++c)
      sums[nearest[i] * channels + c] += static_cast<double>(pixels.pixels[i * channels + c]);
  }
  for (std::size_t j = 0; j < sums.size(); ++j)
    if (counts[j / channels] > 0)
      palette.colours[j] = static_cast<float>(sums[j] / counts[j / channels]);
}

}  // namespace

Palette learn_palette(const Image& image, int colours, Random random) {
  const Image pixels = sample(image, random.stream(0));
  Palette palette = spread_out(pixels, colours, random.stream(1));
  for (int round = 0; round < rounds; ++round) move_to_means(palette, pixels);
  return palette;
}

std::vector<std::uint8_t> nearest_colours(const Image& image, const Palette& palette) {
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<std::uint8_t> nearest(pixel_count(image));
  parallel_for(
      static_cast<std::int64_t>(nearest.size()), 4096, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          float least = std::numeric_limits<float>::infinity();
          for (int k = 0; k < palette.size(); ++k) {
            const float d = squared_distance(
                image.pixels.data() + i * channels,
                palette.colours.data() + static_cast<std::size_t>(k) * channels, channels);
            if (d < least) {
              least = d;
              nearest[i] = static_cast<std::uint8_t>(k);
            }
          }
        }
      });
  return nearest;
}

}  // namespace gramloom
