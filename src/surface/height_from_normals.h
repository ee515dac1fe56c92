#pragma once

#include "core/image.h"

namespace gramloom {

/// The height map whose slopes come closest, in the sense of least squares, to those of unit
/// normals (surface/normal_map.h): integration in the Fourier domain (Frankot, Chellappa 1988, "A
/// method for enforcing integrability in shape from shading algorithms", equation 21).
///
/// On axes that wrap the heights wrap too; on others the field is mirrored at the edges first, as a
/// cosine transform would. Departure: the transfer function is that of central differences, i sin
/// ω, up to a quarter of the sampling frequency, where it is what made the normals, and i 2ω/π
/// beyond, where central differences go blind. Heights come back within 1 % of their range for
/// fields whose features are eight pixels wide or more; finer detail is smoothed.
///
/// The mean slope of an axis that wraps is lost, as is the absolute height: the result has its
/// smallest value at 0, in units of `strength` (the pixels that a value of 1 stands for).
/// Normals that point sideways or into the surface (z below 0.01) count as z = 0.01.
Image height_from_normals(const Image& normals, double strength, Tile wraps);

}  // namespace gramloom
