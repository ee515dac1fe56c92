#include "surface/coordinates.h"

#include "core/error.h"

namespace gramloom {

namespace {

// Around a pole the gradient of the angle has no bound: within this distance it stays the same.
constexpr float least_radius = 1e-4f;

// The point in the frame, in units of its size.
Vec3 inside(const MappingFrame& frame, const Vec3& p) {
  const Vec3 q = (p - frame.origin) / frame.size;
  return {dot(q, frame.x), dot(q, frame.y), dot(q, frame.z)};
}

// A gradient in the frame's terms as one in space.
Vec3 outside(const MappingFrame& frame, const Vec3& g) {
  return (frame.x * g.x + frame.y * g.y + frame.z * g.z) / frame.size;
}

// θ / 2π in [0, 1), and its gradient.
struct Turn {
  float u;
  Vec3 gradient;
};
Turn turn_of(const Vec3& q) {
  float u = std::atan2(q.y, q.x) / (2 * pi);
  if (u < 0) u += 1;
  if (u >= 1) u = 0;  // −1e-9 + 1 is 1 in floats
  const float r2 = std::max(q.x * q.x + q.y * q.y, least_radius * least_radius);
  return {u, Vec3{-q.y, q.x, 0} / (2 * pi * r2)};
}

}  // namespace

MappingFrame mapping_frame(const Vec3& origin, const Vec3& pole, const Vec3& seam, float size) {
  if (length(pole) == 0 || length(seam) == 0) throw Error("a pole or seam has no direction");
  const Vec3 z = normalised(pole);
  const Vec3 across = seam - z * dot(seam, z);
  if (length(across) <= 1e-6f * length(seam)) throw Error("pole and seam are parallel");
  const Vec3 x = normalised(across);
  return {origin, x, cross(z, x), z, size};
}

LinearMap linear_map(const Vec3& origin, const Vec3& a, const Vec3& b) {
  const float aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
  const float determinant = aa * bb - ab * ab;
  if (!(determinant > 1e-9f * aa * bb)) throw Error("the axes of u and v are parallel");
  return {origin, (a * bb - b * ab) / determinant, (b * aa - a * ab) / determinant};
}

Coordinates linear(const LinearMap& map, const Vec3& p) {
  const Vec3 q = p - map.origin;
  return {0.5f + dot(q, map.du), 0.5f + dot(q, map.dv), map.du, map.dv};
}

Coordinates planar(const MappingFrame& frame, const Vec3& p) {
  const Vec3 q = inside(frame, p);
  return {0.5f - q.y, 0.5f + q.z, frame.y / -frame.size, frame.z / frame.size};
}

Vec3 in_solid(const MappingFrame& frame, const Vec3& p) {
  const Vec3 q = inside(frame, p);
  return {0.5f - q.y, 0.5f + q.z, 0.5f - q.x};
}

Coordinates cylindrical(const MappingFrame& frame, const Vec3& p) {
  const Vec3 q = inside(frame, p);
  const Turn turn = turn_of(q);
  return {turn.u, 0.5f + q.z, outside(frame, turn.gradient), frame.z / frame.size};
}

Coordinates polar(const MappingFrame& frame, const Vec3& p) {
  const Vec3 q = inside(frame, p);
  const Turn turn = turn_of(q);
  const float r = std::sqrt(q.x * q.x + q.y * q.y);
  const float phi = std::atan2(r, q.z);
  // ∇φ = (z x, z y, −r²) / (ρ² r)
  const float distance2 = std::max(dot(q, q), least_radius * least_radius);
  const float safe = std::max(r, least_radius);
  const Vec3 gradient = Vec3{q.z * q.x, q.z * q.y, -r * safe} / (distance2 * safe);
  return {turn.u, 1 - phi / pi, outside(frame, turn.gradient), outside(frame, gradient / -pi)};
}

Coordinates conical(const MappingFrame& frame, float half_angle, const Vec3& p) {
  const Vec3 q = inside(frame, p);
  const Turn turn = turn_of(q);
  const float r = std::sqrt(q.x * q.x + q.y * q.y);
  const float c = std::cos(half_angle), s = std::sin(half_angle);
  // The way from the tip down the side, over the side's length 1 / c.
  const float way = ((0.5f - q.z) * c + r * s) * c;
  const float safe = std::max(r, least_radius);
  const Vec3 gradient{s * c * q.x / safe, s * c * q.y / safe, -c * c};
  return {turn.u, 1 - way, outside(frame, turn.gradient), outside(frame, -gradient)};
}

CubePoint cube(const MappingFrame& frame, const Vec3& p) {
  const Vec3 q = inside(frame, p);
  const Vec3 size{std::abs(q.x), std::abs(q.y), std::abs(q.z)};
  // The face's axis, and those of u and v on it.
  CubePoint point;
  Vec3 out, right, up;
  if (size.x >= size.y && size.x >= size.z) {
    point.face = q.x >= 0 ? 0 : 1;
    out = {q.x >= 0 ? 1.0f : -1.0f, 0, 0};
    right = {0, out.x, 0};
    up = {0, 0, 1};
  } else if (size.y >= size.z) {
    point.face = q.y >= 0 ? 2 : 3;
    out = {0, q.y >= 0 ? 1.0f : -1.0f, 0};
    right = {-out.y, 0, 0};
    up = {0, 0, 1};
  } else {
    point.face = q.z >= 0 ? 4 : 5;
    out = {0, 0, q.z >= 0 ? 1.0f : -1.0f};
    right = {0, 1, 0};
    up = {-out.z, 0, 0};
  }
  const float m = std::max(dot(q, out), 1e-12f);
  const float a = dot(q, right) / m, b = dot(q, up) / m;
  point.at = {0.5f + 0.5f * a, 0.5f + 0.5f * b, outside(frame, (right - out * a) * (0.5f / m)),
              outside(frame, (up - out * b) * (0.5f / m))};
  return point;
}

Coordinates barycentric(const Vec3 (&corners)[3], const Vec2 (&coordinates)[3], float b1,
                        float b2) {
  const float b3 = 1 - b1 - b2;
  const Vec2 at = coordinates[0] * b1 + coordinates[1] * b2 + coordinates[2] * b3;
  const Vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
  const Vec2 c1 = coordinates[1] - coordinates[0], c2 = coordinates[2] - coordinates[0];
  const float aa = dot(e1, e1), ab = dot(e1, e2), bb = dot(e2, e2);
  const float determinant = aa * bb - ab * ab;
  if (!(determinant > 0)) return {at.u, at.v, {}, {}};
  // The edges' dual basis: a field that grows by c along its edge and not along the other.
  const Vec3 d1 = (e1 * bb - e2 * ab) / determinant, d2 = (e2 * aa - e1 * ab) / determinant;
  return {at.u, at.v, d1 * c1.u + d2 * c2.u, d1 * c1.v + d2 * c2.v};
}

}  // namespace gramloom
