#include "surface/shapes.h"

#include "surface/arm.h"

namespace gramloom {

namespace {

// How many edges of at most `longest` a length needs.
int pieces(float length, float longest, int least) {
  return std::max(least, static_cast<int>(std::ceil(length / longest)));
}

// The direction at θ = 2πu around y, from the seam behind; the same point at u = 0 and 1.
Vec3 around(float u) {
  if (u >= 1) u = 0;
  return {-std::sin(2 * pi * u), 0, -std::cos(2 * pi * u)};
}

Mesh sphere(float longest) {
  Mesh mesh;
  const int rows = pieces(pi, longest, 96);
  add_grid(mesh, 2 * rows, rows, [](float u, float v) {
    // At the poles exactly, so that all that meet there are the same point.
    const float r = v <= 0 || v >= 1 ? 0 : std::sin(pi * v);
    const Vec3 p = around(u) * r + Vec3{0, v >= 1 ? 1 : v <= 0 ? -1 : -std::cos(pi * v), 0};
    return Vertex{p, normalised(p), {u, v}};
  });
  return mesh;
}

Mesh plane(float longest) {
  Mesh mesh;
  const int n = pieces(2, longest, 1);
  add_grid(mesh, n, n, [](float u, float v) {
    return Vertex{{2 * u - 1, 0, 1 - 2 * v}, {0, 1, 0}, {u, v}};
  });
  return mesh;
}

Mesh cube(float longest) {
  constexpr float half = 0.7f;
  constexpr Vec3 outward[]{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  constexpr Vec3 upward[]{{0, 1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}};
  Mesh mesh;
  const int n = pieces(2 * half, longest, 1);
  for (int face = 0; face < 6; ++face) {
    const Vec3 out = outward[face], up = upward[face], right = cross(up, out);
    add_grid(mesh, n, n, [&](float u, float v) {
      return Vertex{(out + right * (2 * u - 1) + up * (2 * v - 1)) * half, out, {u, v}};
    });
  }
  return mesh;
}

Mesh cylinder(float longest) {
  constexpr float radius = 0.7f;
  Mesh mesh;
  const int columns = pieces(2 * pi * radius, longest, 192);
  add_grid(mesh, columns, pieces(2 * radius, longest, 1), [](float u, float v) {
    const Vec3 out = around(u);
    return Vertex{(out + Vec3{0, 2 * v - 1, 0}) * radius, out, {u, v}};
  });
  for (const float side : {1.0f, -1.0f})
    add_grid(mesh, columns, pieces(radius, longest, 1), [side](float u, float v) {
      // Rings: from the rim inwards on top, outwards below, so that both are seen from outside.
      const float r = side > 0 ? 1 - v : v;
      const Vec3 p = around(u) * r;
      return Vertex{(p + Vec3{0, side, 0}) * radius,
                    {0, side, 0},
                    {0.5f + 0.5f * p.x, 0.5f - 0.5f * p.z * side}};
    });
  return mesh;
}

// Open at both ends, as a sleeve is.
Mesh tube(float longest, double bend) {
  constexpr auto radius = static_cast<float>(2 / arm_length);
  const ArmAxis axis(bend);
  Mesh mesh;
  add_grid(
      mesh, pieces(2 * pi * radius, longest, 192), pieces(2, longest, 96), [&](float u, float v) {
        const double along = (0.5 - static_cast<double>(v)) * arm_length;
        const double around = u >= 1 ? 0 : static_cast<double>(u);
        const auto at = [&](double from) {
          const ArmPoint p = point_at(axis, {along, around, from});
          return Vec3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        };
        return Vertex{at(1) * radius, normalised(at(1) - at(0)), {u, v}};
      });
  // Around the middle of the room that it takes.
  Vec3 low{0, 1, 1}, high{0, -1, -1};
  for (const Vec3& p : mesh.positions) {
    low = {0, std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {0, std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  for (Vec3& p : mesh.positions) p = p - (low + high) * 0.5f;
  return mesh;
}

}  // namespace

Mesh make_shape(Shape shape, float longest, double bend) {
  switch (shape) {
    case Shape::sphere:
      return sphere(longest);
    case Shape::plane:
      return plane(longest);
    case Shape::cube:
      return cube(longest);
    case Shape::cylinder:
      return cylinder(longest);
    case Shape::teapot: {
      // A patch is about 3 units wide, and the pot 6.4 to be brought to 2.
      return fitted(teapot(pieces(1, longest, 24)));
    }
    case Shape::tube:
      return tube(longest, bend);
  }
  return {};
}

float widths_around(Shape shape) {
  switch (shape) {
    case Shape::sphere:
      return 2;
    case Shape::cylinder:
      return pi;
    case Shape::tube:
      return 2 * pi / static_cast<float>(arm_length);
    default:
      return 1;
  }
}

}  // namespace gramloom
