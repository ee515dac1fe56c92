#include "jobs/usable_part.h"

#include <algorithm>
#include <vector>

namespace gramloom {

namespace {

/// The largest rectangle that ends with this row, of columns that reach so far up.
Rectangle largest_in(const std::vector<int>& heights, int row) {
  struct Column {
    int first;  // that the height reaches to the left
    int height;
  };
  Rectangle best;
  std::vector<Column> open;  // ever higher
  const int width = static_cast<int>(heights.size());
  for (int x = 0; x <= width; ++x) {
    const int height = x < width ? heights[static_cast<std::size_t>(x)] : 0;
    int first = x;
    while (!open.empty() && open.back().height >= height) {
      const Column column = open.back();
      open.pop_back();
      first = column.first;
      if (column.height * (x - first) > best.width * best.height)
        best = {first, row - column.height + 1, x - first, column.height};
    }
    open.push_back({first, height});
  }
  return best;
}

}  // namespace

Rectangle usable_part(const Exemplar& exemplar) {
  const Image& mask = exemplar.mask;
  if (mask.empty()) return {0, 0, exemplar.image.width, exemplar.image.height};
  std::vector<int> heights(static_cast<std::size_t>(mask.width));
  Rectangle best;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      int& height = heights[static_cast<std::size_t>(x)];
      height = *mask.at(x, y) > 0.5f ? height + 1 : 0;
    }
    const Rectangle here = largest_in(heights, y);
    if (here.width * here.height > best.width * best.height) best = here;
  }
  return best;
}

Image cut_out(const Image& image, const Rectangle& part) {
  if (part.width == image.width && part.height == image.height) return image;
  Image result(part.width, part.height, image.channels);
  for (int y = 0; y < part.height; ++y)
    std::copy_n(image.at(part.x, part.y + y),
                static_cast<std::size_t>(part.width) * static_cast<std::size_t>(image.channels),
                result.at(0, y));
  return result;
}

}  // namespace gramloom
