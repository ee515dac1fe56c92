#pragma once

#include <functional>

#include "core/image.h"

namespace gramloom {

/// Throws Error unless `height` is a height map: a picture of one channel, and not empty.
void check_height(const Image& height);

/// Three rows of a height map in pixels, one above the other, each with a value before its first
/// and one after its last: what central differences at the middle row look at.
struct GroundRows {
  const float* above;
  const float* here;
  const float* below;
};

/// Calls row(y, rows) for every row of a height map, in parallel. rows.here[x] is the height at x,
/// times `strength` (the pixels that a value of 1 stands high), for x from −1 to width: across the
/// edges of axes that wrap, the other side's; beyond others the ground goes on with the slope of
/// its last two pixels, so that a ramp stays one. An axis of one pixel is level.
void for_each_ground_row(const Image& height, double strength, Tile wraps,
                         const std::function<void(int y, const GroundRows& rows)>& row);

}  // namespace gramloom
