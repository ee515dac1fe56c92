#include "classic/pixel_plane.h"

#include <algorithm>

#include "core/threads.h"

namespace gramloom::pixel {

Plane::Plane(const Canvas& canvas, const Level& level, const Aim& aim, int border)
    : level_(level),
      aim_(aim),
      border_(border),
      image_(canvas.size.width + 2 * border, canvas.size.height + 2 * border,
             level.colours.channels) {
  parallel_for(image_.height, 32, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin) - border_; y < static_cast<int>(end) - border_; ++y)
      for (int x = -border_; x < canvas.size.width + border_; ++x) set(canvas, x, y);
  });
}

void Plane::set(const Canvas& canvas, int x, int y) {
  int inside_x = x, inside_y = y;
  if (canvas.wrap(inside_x, inside_y) && !aim_.is_made(canvas.index(inside_x, inside_y))) {
    std::copy_n(aim_.colours.at(inside_x, inside_y), image_.channels,
                image_.at(x + border_, y + border_));
    return;
  }
  const int edge_x = std::clamp(inside_x, 0, canvas.size.width - 1);
  const int edge_y = std::clamp(inside_y, 0, canvas.size.height - 1);
  const Point edge = canvas.at(edge_x, edge_y);
  const Point p = level_.nearest(
      {edge.x + (inside_x - edge_x) * level_.step, edge.y + (inside_y - edge_y) * level_.step});
  std::copy_n(level_.colours.at(p.x, p.y), image_.channels, image_.at(x + border_, y + border_));
}

void Plane::set_border(const Canvas& canvas) {
  const int width = canvas.size.width, height = canvas.size.height;
  for (int y = -border_; y < height + border_; ++y)
    for (int x = -border_; x < width + border_; ++x) {
      if (x == 0 && y >= 0 && y < height) x = width;
      set(canvas, x, y);
    }
}

}  // namespace gramloom::pixel
