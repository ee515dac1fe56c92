#pragma once

#include "core/fields.h"
#include "surface/vec3.h"

namespace gramloom {

/// How a point of a surface gets its texture coordinates.
enum class Mapping { own, linear, planar, cylindrical, polar, conical, cube, solid };
template <>
inline constexpr auto enum_names<Mapping> = std::to_array<std::string_view>(
    {"own", "linear", "planar", "cylindrical", "polar", "conical", "cube", "solid"});

/// Texture coordinates of a point, and their gradients in space: how fast u and v change along a
/// direction d is dot(du, d) and dot(dv, d).
struct Coordinates {
  float u = 0, v = 0;
  Vec3 du, dv;
};

/// Where a mapping stands. Its z axis is the pole, its x axis points to the seam, where u = 0;
/// `size` is the length that counts as 1.
struct MappingFrame {
  Vec3 origin;
  Vec3 x{0, 0, -1}, y{-1, 0, 0}, z{0, 1, 0};  // orthonormal; the seam is behind
  float size = 2;
};
/// Throws Error when the pole or the seam has no length, or both are parallel. The seam is taken
/// at right angles to the pole.
MappingFrame mapping_frame(const Vec3& origin, const Vec3& pole, const Vec3& seam, float size);

// In what follows (x, y, z) is the point in the frame, in units of its size, θ its angle around
// the pole and φ its angle from it. The picture's middle is at the origin: hence the halves.

/// p = origin + (u − ½) a + (v − ½) b, and beside that plane what is nearest. The axes a and b need
/// not be orthogonal. Throws Error when they are parallel.
struct LinearMap {
  Vec3 origin, du, dv;
};
LinearMap linear_map(const Vec3& origin, const Vec3& a, const Vec3& b);
Coordinates linear(const LinearMap& map, const Vec3& p);

/// u = ½ − y, v = ½ + z: seen from the side that is away from the seam.
Coordinates planar(const MappingFrame& frame, const Vec3& p);
/// (½ − y, ½ + z, ½ − x): where in the unit cube a point of a solid lies. In the usual frame, of
/// size 2, that of the shape's own x, y and z.
Vec3 in_solid(const MappingFrame& frame, const Vec3& p);
/// u = θ / 2π, and u + 1 where that is negative; v = ½ + z.
Coordinates cylindrical(const MappingFrame& frame, const Vec3& p);
/// u as above; v = 1 − φ / π.
Coordinates polar(const MappingFrame& frame, const Vec3& p);
/// u as above; v is 1 at the tip of a cone that stands at z = ½, and falls by the way down its side
/// to 0 at z = −½. `half_angle`: between the side and the axis, in radians. Points beside the cone
/// get what is nearest on its side.
Coordinates conical(const MappingFrame& frame, float half_angle, const Vec3& p);

/// Central projection on the six faces of a cube: the face that lies along the component of largest
/// size m, u and v = ½ (1 + c / |m|) of the two others, upright as seen from outside.
struct CubePoint {
  int face = 0;  // +x, −x, +y, −y, +z, −z
  Coordinates at;
};
CubePoint cube(const MappingFrame& frame, const Vec3& p);

/// b₁ c₁ + b₂ c₂ + (1 − b₁ − b₂) c₃: those of a point of a triangle of a mesh, with the gradients
/// in the triangle's plane. A triangle of no area has none.
Coordinates barycentric(const Vec3 (&corners)[3], const Vec2 (&coordinates)[3], float b1, float b2);

}  // namespace gramloom
