#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gramloom {

inline constexpr float pi = std::numbers::pi_v<float>;

/// A point or direction in space, or a colour: x, y, z or red, green, blue. Objects lie within
/// about [−1, 1]³; x points right, y up and z to the viewer.
struct Vec3 {
  float x = 0, y = 0, z = 0;

  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// Texture coordinates: u to the right and v up the picture, which covers [0, 1]².
struct Vec2 {
  float u = 0, v = 0;

  friend bool operator==(const Vec2&, const Vec2&) = default;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3 operator*(const Vec3& a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(float s, const Vec3& a) { return a * s; }
inline Vec3 operator/(const Vec3& a, float s) { return a * (1 / s); }
inline Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }

inline Vec2 operator+(const Vec2& a, const Vec2& b) { return {a.u + b.u, a.v + b.v}; }
inline Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.u - b.u, a.v - b.v}; }
inline Vec2 operator*(const Vec2& a, float s) { return {a.u * s, a.v * s}; }

inline float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// The unit vector along a; (0, 0, 1) when a has no length.
inline Vec3 normalised(const Vec3& a) {
  const float l = length(a);
  return l > 0 ? a * (1 / l) : Vec3{0, 0, 1};
}
/// a where t is 0, b where it is 1.
inline Vec3 mix(const Vec3& a, const Vec3& b, float t) { return a + (b - a) * t; }
/// The direction d, which points away from a surface with this unit normal, mirrored at it.
inline Vec3 mirrored(const Vec3& d, const Vec3& normal) {
  return normal * (2 * dot(d, normal)) - d;
}

/// Two unit vectors that make a right-handed frame with the unit vector n (Duff et al. 2017,
/// "Building an orthonormal basis, revisited").
struct Tangents {
  Vec3 x, y;
};
inline Tangents tangents(const Vec3& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z);
  const float b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

}  // namespace gramloom
