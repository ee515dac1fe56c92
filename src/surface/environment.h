#pragma once

#include <array>
#include <span>

#include "core/fields.h"
#include "core/image.h"
#include "surface/vec3.h"

namespace gramloom {

/// What a picture of the surroundings shows.
///   latlong      latitude and longitude: twice as wide as high, its middle straight ahead (−z)
///   mirror_ball  a photograph of a mirroring ball, square, the ball touches all four edges
///   sky_box      six faces of a cube around the viewer: a cross 4:3 or 3:4, or a strip 6:1 of +x,
///                −x, +y, −y, +z, −z
///   automatic    which of these by the picture's proportions
enum class EnvironmentKind { automatic, latlong, mirror_ball, sky_box };
template <>
inline constexpr auto enum_names<EnvironmentKind> =
    std::to_array<std::string_view>({"automatic", "latlong", "mirror_ball", "sky_box"});

/// (u, v) of a latitude–longitude picture for a unit direction: u = ½ + atan2(x, −z) / 2π,
/// v = ½ + asin(y) / π; and back.
Vec2 latlong_of(const Vec3& direction);
Vec3 direction_of_latlong(const Vec2& at);

/// (u, v) = ½ (n_x + 1, n_y + 1) of a photographed mirror ball, where n is the ball's unit normal.
Vec2 mirror_ball_of_normal(const Vec3& normal);
/// The same for the direction from which light comes that the ball mirrors to a camera far away on
/// the +z axis: n is the unit vector half-way between the two. (0, 0, −1), behind the ball, is its
/// whole rim: the middle of the lower edge stands for it.
Vec2 mirror_ball_of(const Vec3& direction);

/// The face of a sky box that a direction points to, and (u, v) on it as seen from inside. Faces in
/// the order +x, −x, +y, −y, +z, −z; those at the sides are upright, the top's and bottom's v lead
/// away from and towards the face −z.
struct BoxPoint {
  int face = 0;
  Vec2 at;
};
BoxPoint sky_box_of(const Vec3& direction);

/// Six pictures of a sky box's faces, in their order, as a strip of three channels. Throws Error
/// for another count, and for faces that are not square or not of one size.
Image sky_box_strip(std::span<const Image> faces);

/// The picture of any kind as a latitude–longitude one of three channels. Throws Error for
/// proportions that the kind does not have.
Image latlong_picture(const Image& picture, EnvironmentKind kind);

/// A studio in linear values: a sky that is brighter above, a floor of `floor` brightness below, a
/// large soft box in the direction `light` and a narrow upright one across from it.
Image studio(const Vec3& light, float floor);

/// The mean of an environment's light, weighted by the cosine, over the half-space around each
/// direction: nine spherical harmonics (Ramamoorthi, Hanrahan 2001, "An efficient representation
/// for irradiance environment maps").
struct Irradiance {
  std::array<Vec3, 9> coefficients;
};
Irradiance irradiance_of(const Image& latlong);
Vec3 irradiance_at(const Irradiance& irradiance, const Vec3& normal);

/// `picture` at (u, v), v up, between its pixels' centres bilinearly; beyond its edges the edge's.
Vec3 bilinear(const Image& picture, const Vec2& at);

}  // namespace gramloom
