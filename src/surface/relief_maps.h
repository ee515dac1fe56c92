#pragma once

#include "core/image.h"

namespace gramloom {

/// How much of the light of an evenly bright sky reaches each point of a height map, 0 to 1: one
/// channel. Along each of `lines` through a point the horizon is looked for on both sides, up to
/// `radius` pixels away; the cosine-weighted integral between the two horizons is that of Jimenez,
/// Wu, Pesce, Jarabo 2016, "Practical real-time strategies for accurate indirect occlusion",
/// equation 7, with tangents in place of angles. The half-space above the surface's own slope is
/// what counts: planes see all of it, level or not, and so do tops.
///   strength  pixels that a value of 1 stands high
///   wraps     axes across whose edges the ground goes on; beyond others there is none
/// Departure: horizons are looked for at each pixel nearby and then ever further apart (an
/// eighth of the distance), as things far away hide the sky only when they are large.
/// Throws Error for a height map of more than one channel, radius < 1 or lines < 1.
Image ambient_occlusion(const Image& height, double strength, int radius, int lines, Tile wraps);

/// The mean curvature H of a height map, one channel: ½ where it is flat, towards 1 on ridges and
/// bumps, towards 0 in grooves and pits, ½ − H·radius/2 between: the top of a ball of `radius`
/// pixels is white, a cylinder of that radius 3/4.
///   H = ((1 + h_y²) h_xx − 2 h_x h_y h_xy + (1 + h_x²) h_yy) / (2 (1 + h_x² + h_y²)^(3/2))
/// with central differences; beyond edges that do not wrap the ground goes on with its slope.
/// `scale` > 0: of the heights weighted by a Gaussian of that deviation, in pixels. Without it the
/// grain of most materials is sharper than any radius, and black and white.
Image curvature(const Image& height, double strength, double radius, double scale, Tile wraps);

}  // namespace gramloom
