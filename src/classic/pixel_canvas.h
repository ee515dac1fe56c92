#pragma once

#include <vector>

#include "classic/pixel_levels.h"
#include "core/request.h"

namespace gramloom::pixel {

/// A result under construction at one level: which sample of the exemplar each pixel comes from.
struct Canvas {
  Size size;
  Tile tile = Tile::none;
  std::vector<Point> source;  // row by row

  Canvas(Size size_, Tile tile_)
      : size(size_),
        tile(tile_),
        source(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height)) {}

  int count() const { return size.width * size.height; }
  Point& at(int x, int y) { return source[index(x, y)]; }
  const Point& at(int x, int y) const { return source[index(x, y)]; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(x);
  }
  /// Brings a position around on axes that tile; false where it lies beyond an edge that does not.
  bool wrap(int& x, int& y) const;
};

/// The size of a result at a level: halved, rounded up, once a level.
Size size_at(Size size, int level);

/// The next finer canvas: the source of each pixel becomes those of 2×2 pixels.
Canvas refined(const Canvas& coarse, const Level& from, const Level& to, Size size);

/// The pixels of the exemplar that a canvas of level 0 names.
SourceMap sources_of(const Canvas& canvas);

}  // namespace gramloom::pixel
