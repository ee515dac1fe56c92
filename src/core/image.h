#pragma once

#include <cstddef>
#include <vector>

namespace gramloom {

/// Width and height in pixels.
struct Size {
  int width = 0;
  int height = 0;

  friend bool operator==(const Size&, const Size&) = default;
};

/// Of a result that is made as a whole: what configs and command lines allow.
inline constexpr int longest_side = 65536;

/// In pixels.
inline double area(Size size) { return static_cast<double>(size.width) * size.height; }

/// An index or a count, which is never negative, as containers have them.
inline std::size_t to_size(int value) { return static_cast<std::size_t>(value); }
inline std::size_t pixel_count(Size size) { return to_size(size.width) * to_size(size.height); }

/// A picture in memory: row-major, channels interleaved, float32.
/// Integer files map to [0, 1]; float files keep their values. Values stay as encoded in the file
/// (no change of gamma). An image is made with at least one pixel and one channel, or it is empty.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> pixels;

  Image() = default;
  /// Throws Error when a dimension is negative or the image does not fit into memory.
  Image(int width_, int height_, int channels_, float value = 0.0f);
  Image(Size size_, int channels_, float value = 0.0f)
      : Image(size_.width, size_.height, channels_, value) {}

  Size size() const { return {width, height}; }
  bool empty() const { return pixels.empty(); }
  std::size_t index(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }
  /// The first channel of pixel (x, y); its other channels follow.
  float* at(int x, int y) { return pixels.data() + index(x, y); }
  const float* at(int x, int y) const { return pixels.data() + index(x, y); }

  friend bool operator==(const Image&, const Image&) = default;
};

/// Smallest and largest value of each channel, for results that stay in the exemplar's range.
struct ChannelRange {
  std::vector<float> low;
  std::vector<float> high;
};
ChannelRange channel_range(const Image& image);

/// Brings every value of `image` into `range` (same number of channels).
void clamp_to(Image& image, const ChannelRange& range);

/// `image` with channels [first, first + count).
Image extract_channels(const Image& image, int first, int count);

/// Which edges of a result must meet seamlessly.
enum class Tile { none, x, y, both };

inline bool tiles_x(Tile tile) { return tile == Tile::x || tile == Tile::both; }
inline bool tiles_y(Tile tile) { return tile == Tile::y || tile == Tile::both; }

/// The Tile of these two axes.
inline Tile wrapping(bool x, bool y) {
  return x ? (y ? Tile::both : Tile::x) : (y ? Tile::y : Tile::none);
}

}  // namespace gramloom
