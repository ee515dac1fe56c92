#pragma once

#include "classic/pixel_canvas.h"
#include "classic/pixel_direction.h"
#include "classic/pixel_features.h"

namespace gramloom::pixel {

/// The colours of a canvas with a border around it, so that every neighbourhood lies in one
/// picture. Known pixels have the colours of the aim. Beyond an edge that does not tile, the source
/// of the edge pixel goes on.
class Plane {
 public:
  Plane(const Canvas& canvas, const Level& level, const Aim& aim, int border);

  /// Takes pixel (x, y) from the canvas; it may lie in the border.
  void set(const Canvas& canvas, int x, int y);
  /// Takes the whole border from the canvas.
  void set_border(const Canvas& canvas);

  const float* at(int x, int y) const { return image_.at(x + border_, y + border_); }

  /// The neighbourhood of pixel (x, y).
  Feature feature(const Projection& projection, int x, int y) const {
    return projection.project(at(x - projection.radius, y - projection.radius),
                              static_cast<std::ptrdiff_t>(image_.width) * image_.channels,
                              image_.channels);
  }

 private:
  const Level& level_;
  const Aim& aim_;
  int border_;
  Image image_;
};

}  // namespace gramloom::pixel
