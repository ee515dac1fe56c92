#pragma once

#include "core/image.h"

namespace gramloom {

// How files hold unit normals: as colours, (component + 1) / 2, or, some in floats, as they are.

/// Whether a normal map's file holds components of [−1, 1] as they are: then one is negative.
bool is_signed(const Image& normal_map);

/// A normal map as colours, whatever its file holds: signed components become (component + 1) / 2.
/// Throws Error for fewer than three channels.
Image as_colours(const Image& normal_map);

/// (x, y, z) of length 1; of no length: (0, 0, 1).
void store_unit(float x, float y, float z, float* to);
/// Brings a pixel's three colours of a normal to unit length, likewise.
void make_unit(float* colour);

/// Throws Error for fewer than three channels.
void check_normal_map(const Image& normal_map);

}  // namespace gramloom
