#pragma once

#include <functional>
#include <vector>

#include "core/image.h"

namespace gramloom {

/// What a pixel of a window is.
enum class PixelState : unsigned char {
  known,
  made,    // in this window
  foreign  // in another one
};

/// A part of a target with holes near each other, which are filled by themselves.
struct PatchWindow {
  int left = 0, top = 0;  // its first pixel in the target, around whose edges it may reach
  Size size;
  Tile tile = Tile::none;          // axes that it spans from end to end and that tile
  int levels = 1;                  // of its pyramid
  std::vector<PixelState> states;  // row by row
};

/// The whole target, all of which is made.
PatchWindow whole_window(Size target, Tile tile, int levels);

/// Windows around the holes of a target (mask: 1 is made), wide enough for their patches on every
/// level: no patch of the finest level touches holes of two. `levels_for` tells how many levels a
/// hole of some width needs. A target most of which would be in windows is one.
std::vector<PatchWindow> windows_of(const Image& mask, Tile tile,
                                    const std::function<int(int width)>& levels_for);

}  // namespace gramloom
