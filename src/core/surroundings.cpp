#include "core/surroundings.h"

#include <algorithm>
#include <cstring>

namespace gramloom {

Box box_of(const Image& mask) {
  Box box{mask.width, mask.height, 0, 0};
  const auto is_made = [](float m) { return m > 0.5f; };
  for (int y = 0; y < mask.height; ++y) {
    const float *begin = mask.at(0, y), *end = begin + mask.width;
    const float* first = std::find_if(begin, end, is_made);
    if (first == end) continue;
    const float* last = end;
    while (!is_made(*(last - 1))) --last;
    box = {std::min(box.left, static_cast<int>(first - begin)), std::min(box.top, y),
           std::max(box.right, static_cast<int>(last - begin)), y + 1};
  }
  return box.bottom > 0 ? box : Box{};
}

Box with_surroundings(const Box& holes, Size picture) {
  constexpr int least = 128;
  const int more = std::max({least, holes.right - holes.left, holes.bottom - holes.top});
  return {std::max(0, holes.left - more), std::max(0, holes.top - more),
          std::min(picture.width, holes.right + more),
          std::min(picture.height, holes.bottom + more)};
}

bool has_enough(const Image& mask, const Box& box) {
  if (mask.empty()) return true;
  std::ptrdiff_t usable = 0;
  for (int y = box.top; y < box.bottom; ++y)
    usable += std::count_if(mask.at(box.left, y), mask.at(box.left, y) + (box.right - box.left),
                            [](float m) { return m > 0.5f; });
  return 4.0 * static_cast<double>(usable) >= area(box.size());
}

bool is_filled(const Exemplar& exemplar, const Target& target, int every) {
  if (target.known.empty() || exemplar.image.size() != target.size) return false;
  const std::size_t bytes = to_size(target.known.channels) * sizeof(float);
  bool any = false;
  for (int y = 0; y < target.size.height; y += every)
    for (int x = 0; x < target.size.width; ++x) {
      if (*target.mask.at(x, y) > 0.5f) continue;
      if (!exemplar.mask.empty() && *exemplar.mask.at(x, y) <= 0.5f) continue;
      any = true;
      if (std::memcmp(target.known.at(x, y), exemplar.image.at(x, y), bytes) != 0) return false;
    }
  return any;
}

}  // namespace gramloom
