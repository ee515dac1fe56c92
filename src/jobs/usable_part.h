#pragma once

#include "core/request.h"

namespace gramloom {

/// Pixels [x, x + width) × [y, y + height).
struct Rectangle {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

/// The largest rectangle of an exemplar of which all may be used; of one without a mask, all.
Rectangle usable_part(const Exemplar& exemplar);

/// That part of an image.
Image cut_out(const Image& image, const Rectangle& part);

}  // namespace gramloom
