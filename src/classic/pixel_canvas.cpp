#include "classic/pixel_canvas.h"

#include <algorithm>

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
      canvas.at(x, y) = to.nearest_usable(
          {p.x * from.ratio + x % 2 * to.step, p.y * from.ratio + y % 2 * to.step});
    }
  return canvas;
}

SourceMap sources_of(const Canvas& canvas) {
  SourceMap sources(canvas.size);
  std::ranges::transform(canvas.source, sources.pixels.begin(),
                         [](Point p) { return Source(p.x, p.y); });
  return sources;
}

}  // namespace gramloom::pixel
