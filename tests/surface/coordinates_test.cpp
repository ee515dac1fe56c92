#include "surface/coordinates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/error.h"

namespace gramloom {
namespace {

// The lectures' frame: the pole up z, the seam along x, lengths as they are.
const MappingFrame plain = mapping_frame({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1);

// The gradients of a mapping against differences.
void expect_gradients(const std::function<Coordinates(const Vec3&)>& at, const Vec3& p) {
  constexpr float step = 1e-3f;
  const Coordinates here = at(p);
  for (const Vec3 d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Coordinates a = at(p - d * step), b = at(p + d * step);
    EXPECT_NEAR(dot(here.du, d), (b.u - a.u) / (2 * step), 2e-3f);
    EXPECT_NEAR(dot(here.dv, d), (b.v - a.v) / (2 * step), 2e-3f);
  }
}

TEST(Coordinates, CylindricalIsTheAngleAndTheHeight) {
  for (const float theta : {0.1f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.2f}) {
    const Vec3 p{2 * std::cos(theta), 2 * std::sin(theta), -0.3f};
    EXPECT_NEAR(cylindrical(plain, p).u, theta / (2 * pi), 1e-6f);
    EXPECT_NEAR(cylindrical(plain, p).v, 0.5f - 0.3f, 1e-6f);
    expect_gradients([](const Vec3& q) { return cylindrical(plain, q); }, p);
  }
}

TEST(Coordinates, TheSeamIsZeroFromBothSidesAndStaysBelowOne) {
  EXPECT_EQ(polar(plain, {1, 0, 0}).u, 0);
  EXPECT_EQ(polar(plain, {1, -1e-9f, 0}).u, 0);  // −1e-10 + 1 would be 1
  EXPECT_NEAR(polar(plain, {1, -1e-3f, 0}).u, 1 - 1e-3f / (2 * pi), 1e-6f);
  EXPECT_NEAR(polar(plain, {1, 1e-3f, 0}).u, 1e-3f / (2 * pi), 1e-6f);
}

TEST(Coordinates, PolarIsTheAngleAroundAndTheAngleFromThePole) {
  EXPECT_EQ(polar(plain, {0, 0, 1}).v, 1);
  EXPECT_NEAR(polar(plain, {0, 0, -1}).v, 0, 1e-6f);
  EXPECT_NEAR(polar(plain, {0, 1, 0}).v, 0.5f, 1e-6f);
  EXPECT_NEAR(polar(plain, {0, -1, 0}).u, 0.75f, 1e-6f);  // −¼ + 1
  const float theta = -2.1f, phi = 0.7f;
  const Vec3 p =
      Vec3{std::sin(phi) * std::cos(theta), std::sin(phi) * std::sin(theta), std::cos(phi)} * 3.0f;
  EXPECT_NEAR(polar(plain, p).u, theta / (2 * pi) + 1, 1e-6f);
  EXPECT_NEAR(polar(plain, p).v, 1 - phi / pi, 1e-6f);
  expect_gradients([](const Vec3& q) { return polar(plain, q); }, p);
}

TEST(Coordinates, PolesHaveFiniteGradients) {
  for (const Vec3 p : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0, 0, 0}}) {
    const Coordinates at = polar(plain, p);
    for (const Vec3 g : {at.du, at.dv}) EXPECT_TRUE(std::isfinite(dot(g, g)));
  }
}

TEST(Coordinates, LinearAxesNeedNotBeOrthogonal) {
  const Vec3 origin{1, 2, 3}, a{2, 0, 0}, b{1, 1, 0};
  const LinearMap map = linear_map(origin, a, b);
  // Half of a, −1.5 of b, and off the plane.
  const Vec3 p = origin + a * 0.5f - b * 1.5f + Vec3{0, 0, 7};
  EXPECT_NEAR(linear(map, p).u, 1, 1e-6f);
  EXPECT_NEAR(linear(map, p).v, -1, 1e-6f);
  expect_gradients([&](const Vec3& q) { return linear(map, q); }, p);
  EXPECT_THROW(linear_map(origin, a, a * -2), Error);
}

TEST(Coordinates, PlanarLooksFromTheSideAwayFromTheSeam) {
  const MappingFrame front;  // pole up, seam behind, 2 large
  EXPECT_NEAR(planar(front, {-1, -1, 0.3f}).u, 0, 1e-6f);
  EXPECT_NEAR(planar(front, {-1, -1, 0.3f}).v, 0, 1e-6f);
  EXPECT_NEAR(planar(front, {1, 1, -5}).u, 1, 1e-6f);
  EXPECT_NEAR(planar(front, {3, 1, -5}).u, 2, 1e-6f);
  expect_gradients([&](const Vec3& q) { return planar(front, q); }, {0.2f, 0.4f, 1});
  const auto expect_place = [](const Vec3& place, const Vec3& expected) {
    EXPECT_LT(length(place - expected), 1e-6f);
  };
  expect_place(in_solid(front, {-1, -1, -1}), {0, 0, 0});
  expect_place(in_solid(front, {1, 0.5f, 0}), {1, 0.75f, 0.5f});
  // The pole, along which a solid's y grows, to the right, half as large, moved.
  const MappingFrame right = mapping_frame({0.5f, 0, 0}, {1, 0, 0}, {0, 0, -1}, 1);
  expect_place(in_solid(right, {1, 0, 0}), {0.5f, 1, 0.5f});
  expect_place(in_solid(right, {0.5f, 0, 0.25f}), {0.5f, 0.5f, 0.75f});
}

TEST(Coordinates, ConicalFallsDownTheSideFromTheTip) {
  const float angle = std::atan(0.5f);  // radius ½ where z = −½
  const auto at = [&](const Vec3& p) { return conical(plain, angle, p); };
  EXPECT_NEAR(at({0, 0, 0.5f}).v, 1, 1e-6f);
  EXPECT_NEAR(at({0, 0.5f, -0.5f}).v, 0, 1e-6f);
  EXPECT_NEAR(at({-0.25f, 0, 0}).v, 0.5f, 1e-6f);
  EXPECT_NEAR(at({-0.25f, 0, 0}).u, 0.5f, 1e-6f);
  expect_gradients(at, {0.2f, -0.1f, 0.1f});
}

TEST(Coordinates, CubeHasSixUprightFaces) {
  const MappingFrame upright;
  // The face that looks at the viewer: u to the right, v up.
  const CubePoint front = cube(upright, {0.5f, 0.25f, 1});
  EXPECT_NEAR(front.at.u, 0.75f, 1e-6f);
  EXPECT_NEAR(front.at.v, 0.625f, 1e-6f);
  const CubePoint right = cube(upright, {2, -1, 1});
  EXPECT_NE(right.face, front.face);
  EXPECT_NEAR(right.at.u, 0.25f, 1e-6f);  // towards the viewer is to the left there
  EXPECT_NEAR(right.at.v, 0.25f, 1e-6f);
  std::set<int> faces;
  for (const Vec3 p : {Vec3{1, 0.1f, 0.2f}, Vec3{-1, 0.1f, 0.2f}, Vec3{0.1f, 1, 0.2f},
                       Vec3{0.1f, -1, 0.2f}, Vec3{0.1f, 0.2f, 1}, Vec3{0.1f, 0.2f, -1}}) {
    faces.insert(cube(upright, p).face);
    expect_gradients([&](const Vec3& q) { return cube(upright, q).at; }, p);
  }
  EXPECT_EQ(faces.size(), 6u);
}

TEST(Coordinates, BarycentricMixesTheCorners) {
  const Vec3 corners[]{{0, 0, 0}, {2, 0, 0}, {0, 0, 3}};
  const Vec2 own[]{{0.1f, 0.2f}, {0.9f, 0.2f}, {0.1f, 0.8f}};
  const float b1 = 0.2f, b2 = 0.5f;
  const Coordinates at = barycentric(corners, own, b1, b2);
  EXPECT_NEAR(at.u, b1 * 0.1f + b2 * 0.9f + (1 - b1 - b2) * 0.1f, 1e-6f);
  EXPECT_NEAR(at.v, b1 * 0.2f + b2 * 0.2f + (1 - b1 - b2) * 0.8f, 1e-6f);
  // u grows by 0.8 over 2 along x, v by 0.6 over 3 along z.
  EXPECT_NEAR(at.du.x, 0.4f, 1e-6f);
  EXPECT_NEAR(at.dv.z, 0.2f, 1e-6f);
  EXPECT_NEAR(at.du.z, 0, 1e-6f);
}

TEST(Coordinates, AnyPositionAndOrientation) {
  // The pole along x, the seam along y, around (5, 0, 0), 4 large.
  const MappingFrame frame = mapping_frame({5, 0, 0}, {2, 0, 0}, {1, 3, 0}, 4);
  EXPECT_NEAR(polar(frame, {6, 0, 0}).v, 1, 1e-6f);
  EXPECT_NEAR(polar(frame, {5, 1, 0}).u, 0, 1e-6f);
  EXPECT_NEAR(polar(frame, {5, 0, 1}).u, 0.25f, 1e-6f);
  EXPECT_NEAR(cylindrical(frame, {7, 0, 1}).v, 1, 1e-6f);
  expect_gradients([&](const Vec3& q) { return polar(frame, q); }, {5.5f, 0.7f, 0.4f});
  EXPECT_THROW(mapping_frame({}, {0, 0, 0}, {1, 0, 0}, 1), Error);
  EXPECT_THROW(mapping_frame({}, {0, 0, 1}, {0, 0, -2}, 1), Error);
}

}  // namespace
}  // namespace gramloom
