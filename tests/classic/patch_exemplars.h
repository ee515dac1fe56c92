#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "core/image.h"
#include "core/random.h"

namespace gramloom {

/// Blobs a few pixels wide: white noise, averaged over 5×5 with wrapped edges twice. No two pixels
/// are equal, so that the origin of a copied pixel can be told from its value.
inline Image blobs(int width, int height, int channels, std::uint64_t seed) {
  Random random(seed);
  Image image(width, height, channels);
  for (float& value : image.pixels) value = random.uniform();
  for (int round = 0; round < 2; ++round) {
    const Image from = image;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < channels; ++c) {
          float sum = 0;
          for (int dy = -2; dy <= 2; ++dy)
            for (int dx = -2; dx <= 2; ++dx)
              sum += from.at((x + dx + 2 * width) % width, (y + dy + 2 * height) % height)[c];
          image.at(x, y)[c] = sum / 25;
        }
  }
  return image;
}

inline Image chessboard(int width, int height, int square) {
  Image image(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      *image.at(x, y) = (x / square + y / square) % 2 == 0 ? 0.0f : 1.0f;
  return image;
}

inline std::vector<float> pixel_at(const Image& image, int x, int y) {
  return {image.at(x, y), image.at(x, y) + image.channels};
}

inline std::set<std::vector<float>> colours(const Image& image) {
  std::set<std::vector<float>> result;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) result.insert(pixel_at(image, x, y));
  return result;
}

/// How a wrapped image's seam compares with its inside: the mean squared difference of neighbours
/// across the right (or lower) edge, divided by the same across the line inside the image, parallel
/// to that edge, where it is largest. Up to 1 no line stands out at the seam.
inline double seam_ratio(const Image& image, bool right_edge) {
  const int length = right_edge ? image.width : image.height;
  const int lines = right_edge ? image.height : image.width;
  std::vector<double> across(static_cast<std::size_t>(length));  // from i to i + 1
  for (int i = 0; i < length; ++i)
    for (int line = 0; line < lines; ++line) {
      const int next = (i + 1) % length;
      const float* a = right_edge ? image.at(i, line) : image.at(line, i);
      const float* b = right_edge ? image.at(next, line) : image.at(line, next);
      for (int c = 0; c < image.channels; ++c)
        across[static_cast<std::size_t>(i)] += std::pow(double{a[c]} - double{b[c]}, 2);
    }
  return across.back() / *std::max_element(across.begin(), across.end() - 1);
}

/// Size in pixels of the largest connected piece of `result` that is a copy of a piece of
/// `exemplar`, none of whose pixels are equal. Wrapped edges do not connect.
inline int largest_copied_piece(const Image& result, const Image& exemplar) {
  std::map<std::vector<float>, int> origin;
  for (int y = 0; y < exemplar.height; ++y)
    for (int x = 0; x < exemplar.width; ++x)
      origin[pixel_at(exemplar, x, y)] = y * exemplar.width + x;
  const int width = result.width, height = result.height;
  std::vector<std::pair<int, int>> shift;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int from = origin.at(pixel_at(result, x, y));
      shift.emplace_back(from % exemplar.width - x, from / exemplar.width - y);
    }
  std::vector<char> seen(shift.size());
  int largest = 0;
  for (int start = 0; start < width * height; ++start) {
    if (seen[static_cast<std::size_t>(start)]) continue;
    std::vector<int> stack{start};
    seen[static_cast<std::size_t>(start)] = 1;
    int size = 0;
    while (!stack.empty()) {
      const int at = stack.back(), x = at % width, y = at / width;
      stack.pop_back();
      ++size;
      for (const int next : {x > 0 ? at - 1 : at, x + 1 < width ? at + 1 : at,
                             y > 0 ? at - width : at, y + 1 < height ? at + width : at})
        if (!seen[static_cast<std::size_t>(next)] &&
            shift[static_cast<std::size_t>(next)] == shift[static_cast<std::size_t>(at)]) {
          seen[static_cast<std::size_t>(next)] = 1;
          stack.push_back(next);
        }
    }
    largest = std::max(largest, size);
  }
  return largest;
}

}  // namespace gramloom
