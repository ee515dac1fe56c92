#include "neural/quarter_means.h"

#include <algorithm>

#include "core/threads.h"

namespace gramloom::neural {

namespace {

// Sums over side × side pixels from each one on, by channel; the picture wraps.
Image box_sums(const Image& image, int side) {
  constexpr int rows_at_once = 8;
  const int channels = image.channels;
  Image along(image.size(), channels), sums(image.size(), channels);
  parallel_for(image.height, rows_at_once, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int i = 0; i < side; ++i)
          for (int c = 0; c < channels; ++c)
            along.at(x, y)[c] += image.at((x + i) % image.width, y)[c];
  });
  parallel_for(image.height, rows_at_once, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < end; ++y)
      for (int i = 0; i < side; ++i) {
        const float* from = along.at(0, (y + i) % image.height);
        float* to = sums.at(0, y);
        for (int k = 0; k < image.width * channels; ++k) to[k] += from[k];
      }
  });
  return sums;
}

}  // namespace

Image patch_sums(const Image& image, int side) { return box_sums(image, side); }

Image quarter_means(const Image& guide, int side) {
  const int half = std::max(1, side / 2), beyond = side - half, channels = guide.channels;
  const Image sums = box_sums(guide, half);
  const float each = 1.0f / static_cast<float>(half * half);
  Image means(guide.size(), 4 * channels);
  for (int y = 0; y < guide.height; ++y)
    for (int x = 0; x < guide.width; ++x)
      for (int quarter = 0; quarter < 4; ++quarter) {
        const float* from = sums.at((x + quarter % 2 * beyond) % guide.width,
                                    (y + quarter / 2 * beyond) % guide.height);
        for (int c = 0; c < channels; ++c) means.at(x, y)[quarter * channels + c] = from[c] * each;
      }
  return means;
}

}  // namespace gramloom::neural
