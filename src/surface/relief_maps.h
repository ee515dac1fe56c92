#pragma once

#include "core/image.h"

namespace gramloom {

/// How much of the sky each point of a height map sees, 0 to 1: one channel. Along each of
/// `directions` over the picture the horizon is looked for up to `radius` pixels away; light from a
/// direction comes in down to its horizon at angle α, and evenly bright sky then lights a level
/// ground by the mean of cos² α (horizon maps: Max 1988, "Horizon mapping: shadows for bump-mapped
/// surfaces"; the cosine-weighted integral over elevation is sin² of the zenith angle).
/// A plane is 1, also a sloping one's upper side is not: the sky below its own slope counts as
/// seen.
///   strength  pixels that a value of 1 stands high
///   wraps     axes across whose edges the ground goes on; beyond others it is level with the edge
/// Throws Error for a height map of more than one channel, radius < 1 or directions < 1.
Image ambient_occlusion(const Image& height, double strength, int radius, int directions,
                        Tile wraps);

/// The mean curvature H of a height map, one channel: ½ where it is flat, towards 1 on ridges and
/// bumps, towards 0 in grooves and pits, ½ − H·radius/2 between: a ball of `radius` pixels is white
/// at its top.
///   H = ((1 + h_y²) h_xx − 2 h_x h_y h_xy + (1 + h_x²) h_yy) / (2 (1 + h_x² + h_y²)^(3/2))
/// with central differences; beyond edges that do not wrap the edge's height goes on.
Image curvature(const Image& height, double strength, double radius, Tile wraps);

}  // namespace gramloom
