#include "surface/arm.h"

#include <cmath>
#include <limits>

#include "core/portable_math.h"

namespace gramloom {

ArmAxis::ArmAxis(double bend)
    // A smaller bend is none: the radius of its arc would swallow all digits.
    : bend_(bend < 1e-4 ? 0 : bend * portable::pi / 180),
      radius_(is_straight() ? std::numeric_limits<double>::infinity() : arm_elbow / bend_),
      sine_(portable::sin(0.5 * bend_)),
      cosine_(portable::cos(0.5 * bend_)),
      end_y_(is_straight() ? -0.5 * arm_elbow : -radius_ * sine_),
      end_z_(is_straight() ? 0 : radius_ * (1 - cosine_)) {}

ArmAxis::Frame ArmAxis::frame(double along) const {
  if (is_straight()) return {-along, 0, -1, 0, 0, 1};
  const double side = along > 0 ? 1 : -1;
  const double way = side * along - 0.5 * arm_elbow;
  if (way > 0)
    return {side * (end_y_ - cosine_ * way),
            end_z_ + sine_ * way,
            -cosine_,
            side * sine_,
            side * sine_,
            cosine_};
  const double angle = along / radius_;
  const double s = portable::sin(angle), c = portable::cos(angle);
  return {-radius_ * s, radius_ * (1 - c), -c, s, s, c};
}

// How far a point lies beyond the arc's end on its own half; the halves are mirror images.
double ArmAxis::way_beyond_arc(double y, double z) const {
  return (end_y_ + std::abs(y)) * cosine_ + (z - end_z_) * sine_;
}

ArmAxis::Nearest ArmAxis::nearest(double y, double z) const {
  if (is_straight()) return {{y, 0, -1, 0, 0, 1}, z};
  if (const double way = way_beyond_arc(y, z); way > 0) {
    const Frame f = frame((y < 0 ? 1 : -1) * (0.5 * arm_elbow + way));
    return {f, (y - f.y) * f.inside_y + (z - f.z) * f.inside_z};
  }
  const double to_y = -y, to_z = radius_ - z;  // the arc's middle
  const double distance = portable::sqrt(to_y * to_y + to_z * to_z);
  const double s = to_y / distance, c = to_z / distance;
  return {{-radius_ * s, radius_ * (1 - c), -c, s, s, c}, radius_ - distance};
}

double ArmAxis::along(double y, double z) const {
  if (is_straight()) return -y;
  if (const double way = way_beyond_arc(y, z); way > 0)
    return (y < 0 ? 1 : -1) * (0.5 * arm_elbow + way);
  return radius_ * portable::atan2(-y, radius_ - z);
}

ArmPoint point_at(const ArmAxis& axis, const ArmPlace& place) {
  const ArmAxis::Frame f = axis.frame(place.along);
  const double angle = 2 * portable::pi * place.around;
  const double inside = -place.from * portable::cos(angle);
  return {-place.from * portable::sin(angle), f.y + inside * f.inside_y, f.z + inside * f.inside_z};
}

ArmPlace place_of(const ArmAxis& axis, const ArmPoint& point) {
  const double inside = axis.nearest(point.y, point.z).inside;
  double around = portable::atan2(-point.x, -inside) / (2 * portable::pi);
  if (around < 0) around += 1;
  return {axis.along(point.y, point.z), around,
          portable::sqrt(point.x * point.x + inside * inside)};
}

}  // namespace gramloom
