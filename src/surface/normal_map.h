#pragma once

#include "core/image.h"
#include "core/map_words.h"
#include "signal/normal_colours.h"

namespace gramloom {

/// Unit normals of a height map, in tangent space: three channels x, y, z in [−1, 1], with x to the
/// right, y up the picture and z out of it; the direction of (−∂h/∂u, −∂h/∂v, 1) with v upwards
/// (bump normals by central differences; Blinn 1978, "Simulation of wrinkled surfaces").
///   height    one channel; `strength` is how many pixels high a value of 1 stands
///   wraps     the axes across whose edges the slope is taken; at others it is that of the edge's
///             last two pixels
/// Throws Error when `height` has another number of channels.
Image normals_from_height(const Image& height, double strength, Tile wraps);

/// The picture of unit normals, RGB = (N + 1) / 2, so that 8 bits hold 255 (N + 1) / 2.
Image normals_to_colours(const Image& normals, GreenAxis green);

/// Brings the normals in channels first to first + 2 of a picture to unit length, as colours; those
/// of no length become (0, 0, 1).
void make_unit(Image& picture, int first = 0);

/// The unit normals of a normal map: N = 2 RGB − 1 of as_colours() (signal/normal_colours.h),
/// divided by its length; a vector of no length becomes (0, 0, 1). Channels beyond the third are
/// left out. Throws Error for fewer than three.
Image colours_to_normals(const Image& picture, GreenAxis green);

}  // namespace gramloom
