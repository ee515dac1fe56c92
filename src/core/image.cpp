#include "core/image.h"

#include <algorithm>
#include <limits>
#include <new>

#include "core/error.h"

namespace gramloom {

Image::Image(int width_, int height_, int channels_, float value)
    : width(width_), height(height_), channels(channels_) {
  if (width < 0 || height < 0 || channels < 0)
    throw Error("an image of {}×{} pixels and {} channels cannot exist", width, height, channels);
  // int × int × int can exceed 64 bits only when an image is far beyond any memory.
  const double values = static_cast<double>(width) * height * channels;
  try {
    if (values > 1e15) throw std::bad_alloc();
    pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                      static_cast<std::size_t>(channels),
                  value);
  } catch (const std::bad_alloc&) {
    throw Error("an image of {}×{} pixels and {} channels does not fit into memory ({:.1f} GB)",
                width, height, channels, values * sizeof(float) / 1e9);
  } catch (const std::length_error&) {
    throw Error("an image of {}×{} pixels and {} channels does not fit into memory", width, height,
                channels);
  }
}

ChannelRange channel_range(const Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  ChannelRange range{std::vector<float>(channels, std::numeric_limits<float>::infinity()),
                     std::vector<float>(channels, -std::numeric_limits<float>::infinity())};
  for (std::size_t first = 0; first < image.pixels.size(); first += channels)
    for (std::size_t c = 0; c < channels; ++c) {
      range.low[c] = std::min(range.low[c], image.pixels[first + c]);
      range.high[c] = std::max(range.high[c], image.pixels[first + c]);
    }
  return range;
}

void clamp_to(Image& image, const ChannelRange& range) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] =
        std::clamp(image.pixels[i], range.low[i % channels], range.high[i % channels]);
}

Image extract_channels(const Image& image, int first, int count) {
  if (first < 0 || count < 1 || first > image.channels - count)
    throw Error("channels {} to {} of an image with {}", first, first + count - 1, image.channels);
  Image result(image.size(), count);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::copy_n(image.at(x, y) + first, count, result.at(x, y));
  return result;
}

}  // namespace gramloom
