#pragma once

#include <vector>

#include "core/fields.h"
#include "core/image.h"
#include "surface/vec3.h"

namespace gramloom {

/// What a picture or volume is beyond its edges: itself again, itself mirrored, its edge, or a
/// colour.
enum class Outside { tile, mirror, clamp, colour };
template <>
inline constexpr auto enum_names<Outside> = std::to_array<std::string_view>({"tile", "mirror",
                                                                             "clamp", "colour"});

/// The index that stands for `i` of `count`, which may lie anywhere; −1: the colour outside.
int index_outside(int i, int count, Outside outside);

/// A solid as a stack of slices of equal size, the first at the back of its depth.
struct Volume {
  std::vector<Image> slices;
};
/// Throws Error for slices of different sizes or channels, or fewer than two.
void check_volume(const Volume& volume);

/// The first three channels (one channel: three times) at a point of [0, 1]³, which the volume
/// covers: x along its rows, y up its pictures and z through the stack. Between the centres of its
/// cells it is interpolated trilinearly, across the edges with what is `outside`.
Vec3 trilinear(const Volume& volume, const Vec3& point, Outside outside, const Vec3& colour);

}  // namespace gramloom
