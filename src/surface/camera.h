#pragma once

#include "core/image.h"
#include "surface/rays.h"

namespace gramloom {

/// The direction of an azimuth (0 to the viewer, +z; 90 right, +x) and an elevation above the
/// horizon, in degrees.
inline Vec3 direction_of(double azimuth, double elevation) {
  constexpr double degree = 0.017453292519943295;
  const double a = azimuth * degree, e = elevation * degree;
  return {static_cast<float>(std::cos(e) * std::sin(a)), static_cast<float>(std::sin(e)),
          static_cast<float>(std::cos(e) * std::cos(a))};
}

/// Where a preview's camera looks: a little below the shape's middle, to see its shadow.
inline constexpr Vec3 preview_target{0, -0.06f, 0};

/// A pinhole camera.
struct Camera {
  Vec3 origin;
  Vec3 corner;       // from the origin to the picture's upper left corner
  Vec3 right, down;  // the steps of a pixel in the picture's plane

  /// Through (x, y) of the picture in pixels.
  Ray ray(float x, float y) const { return {origin, normalised(corner + right * x + down * y)}; }
  /// How far such a ray moves, at `distance`, from one pixel to the next.
  float pixel_width(float distance) const { return distance * length(right) / length(corner); }
};

/// A camera in the direction `from` of `target`, which sees a ball of `radius` around it fill about
/// four fifths of the shorter side when zoom is 1.
inline Camera make_camera(const Vec3& from, const Vec3& target, float radius, float zoom,
                          Size size) {
  constexpr float half_view = 0.22f;  // the tangent of half of what the shorter side sees
  const float distance = radius / (half_view * 0.79f);
  // Looking straight down or up, the picture's top is away from the viewer.
  const Vec3 up = std::abs(from.y) > 0.9999f ? Vec3{0, 0, -from.y} : Vec3{0, 1, 0};
  const Vec3 right = normalised(cross(up, from)), above = cross(from, right);
  const float step = 2 * half_view / zoom / static_cast<float>(std::min(size.width, size.height));
  Camera camera;
  camera.origin = target + from * distance;
  camera.right = right * step;
  camera.down = above * -step;
  camera.corner = -from - camera.right * (0.5f * static_cast<float>(size.width)) -
                  camera.down * (0.5f * static_cast<float>(size.height));
  return camera;
}

}  // namespace gramloom
