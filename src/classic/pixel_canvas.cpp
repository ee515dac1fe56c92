#include "classic/pixel_canvas.h"

#include <algorithm>

#include "core/threads.h"

namespace gramloom::pixel {

bool Canvas::wrap(int& x, int& y) const {
  if (tiles_x(tile)) x = (x % size.width + size.width) % size.width;
  if (tiles_y(tile)) y = (y % size.height + size.height) % size.height;
  return x >= 0 && y >= 0 && x < size.width && y < size.height;
}

Size size_at(Size size, int level) {
  for (; level > 0; --level) size = {(size.width + 1) / 2, (size.height + 1) / 2};
  return size;
}

Canvas refined(const Canvas& coarse, const Level& from, const Level& to, Size size) {
  Canvas canvas(size, coarse.tile);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Point p = coarse.at(x / 2, y / 2);
      canvas.at(x, y) =
          to.nearest({p.x * from.ratio + x % 2 * to.step, p.y * from.ratio + y % 2 * to.step});
    }
  return canvas;
}

Image colours_of(const Canvas& canvas, const Image& exemplar) {
  Image result(canvas.size, exemplar.channels);
  parallel_for(canvas.size.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < canvas.size.width; ++x) {
        const Point p = canvas.at(x, y);
        std::copy_n(exemplar.at(p.x, p.y), exemplar.channels, result.at(x, y));
      }
  });
  return result;
}

}  // namespace gramloom::pixel
