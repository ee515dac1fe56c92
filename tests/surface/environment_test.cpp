#include "surface/environment.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace gramloom {
namespace {

TEST(Environment, MirrorBallByHand) {
  // The lectures' formula.
  EXPECT_EQ(mirror_ball_of_normal({0, 0, 1}), (Vec2{0.5f, 0.5f}));
  EXPECT_EQ(mirror_ball_of_normal({-1, 0, 0}), (Vec2{0, 0.5f}));
  EXPECT_EQ(mirror_ball_of_normal({0, 1, 0}), (Vec2{0.5f, 1}));
  // The middle mirrors the camera; a place at 45° what is beside it; the rim what is behind it.
  EXPECT_EQ(mirror_ball_of({0, 0, 1}), (Vec2{0.5f, 0.5f}));
  const float side = 0.5f + 0.5f * std::sqrt(0.5f);
  EXPECT_NEAR(mirror_ball_of({1, 0, 0}).u, side, 1e-6f);
  EXPECT_NEAR(mirror_ball_of({0, -1, 0}).v, 1 - side, 1e-6f);
  const Vec2 behind = mirror_ball_of(normalised({1e-3f, 0, -1}));
  EXPECT_NEAR(behind.u, 1, 1e-3f);
  // The law of reflection: the ball's normal there is half-way.
  const Vec3 d = normalised({0.3f, -0.7f, -0.2f});
  const Vec2 at = mirror_ball_of(d);
  const float x = 2 * at.u - 1, y = 2 * at.v - 1;
  const Vec3 n{x, y, std::sqrt(1 - x * x - y * y)};
  EXPECT_NEAR(dot(mirrored({0, 0, 1}, n), d), 1, 1e-6f);
}

TEST(Environment, LatitudeLongitudeAndBack) {
  EXPECT_NEAR(latlong_of({0, 0, -1}).u, 0.5f, 1e-6f);
  EXPECT_NEAR(latlong_of({1, 0, 0}).u, 0.75f, 1e-6f);
  EXPECT_NEAR(latlong_of({0, 1, 0}).v, 1, 1e-6f);
  for (const Vec3 d : {Vec3{0.2f, 0.5f, 0.7f}, Vec3{-3, -1, -0.1f}, Vec3{0.1f, -0.9f, 1}}) {
    const Vec3 unit = normalised(d);
    EXPECT_NEAR(dot(direction_of_latlong(latlong_of(unit)), unit), 1, 1e-6f);
  }
}

TEST(Environment, SkyBoxFacesMeetAtTheirEdges) {
  EXPECT_EQ(sky_box_of({0, 0, -1}).face, 5);
  EXPECT_EQ(sky_box_of({0, 0, -1}).at, (Vec2{0.5f, 0.5f}));
  // From the face ahead to its right neighbour, and up to the top.
  EXPECT_NEAR(sky_box_of({0.999f, 0.3f, -1}).at.u, 1, 1e-3f);
  EXPECT_EQ(sky_box_of({1, 0.3f, -0.999f}).face, 0);
  EXPECT_NEAR(sky_box_of({1, 0.3f, -0.999f}).at.u, 0, 1e-3f);
  EXPECT_EQ(sky_box_of({0.2f, 1, -0.999f}).face, 2);
  EXPECT_NEAR(sky_box_of({0.2f, 1, -0.999f}).at.v, 0, 1e-3f);
  EXPECT_NEAR(sky_box_of({0.2f, 1, -0.999f}).at.u, 0.6f, 1e-3f);
  EXPECT_NEAR(sky_box_of({0.2f, -1, -0.999f}).at.v, 1, 1e-3f);
}

// A picture whose every colour is the direction that it shows.
template <class Direction>
Image picture_of(int width, int height, Direction&& direction) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3 d = direction((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                               1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
      float* p = image.at(x, y);
      p[0] = d.x;
      p[1] = d.y;
      p[2] = d.z;
    }
  return image;
}

void expect_directions(const Image& latlong, float least) {
  for (const Vec3 d : {Vec3{0.2f, 0.5f, 0.7f}, Vec3{-1, -0.3f, -0.4f}, Vec3{0.5f, -0.6f, 1},
                       Vec3{0.9f, 0.2f, 0.1f}, Vec3{0.2f, 1, 0.1f}, Vec3{0.1f, -1, -0.2f}}) {
    const Vec3 unit = normalised(d);
    EXPECT_GT(dot(normalised(bilinear(latlong, latlong_of(unit))), unit), least) << d.x << d.y;
  }
}

TEST(Environment, EveryKindBecomesLatitudeAndLongitude) {
  const Image ball = picture_of(256, 256, [](float u, float v) {
    const float x = 2 * u - 1, y = 2 * v - 1;
    const Vec3 n{x, y, std::sqrt(std::max(0.0f, 1 - x * x - y * y))};
    return mirrored({0, 0, 1}, normalised(n));
  });
  expect_directions(latlong_picture(ball, EnvironmentKind::automatic), 0.99f);
  const Image strip = picture_of(6 * 64, 64, [](float u, float v) {
    const int face = std::min(5, static_cast<int>(u * 6));
    const float a = 2 * (u * 6 - static_cast<float>(face)) - 1, b = 2 * v - 1;
    const Vec3 faces[]{{1, b, a}, {-1, b, -a}, {a, 1, b}, {a, -1, -b}, {-a, b, 1}, {a, b, -1}};
    return normalised(faces[face]);
  });
  expect_directions(latlong_picture(strip, EnvironmentKind::automatic), 0.999f);
  EXPECT_EQ(latlong_picture(strip, EnvironmentKind::automatic).height, 2 * 64)
      << "as fine as the faces are";
  const Image cross = picture_of(256, 192, [](float u, float v) {
    const float x = u * 4, y = (1 - v) * 3;
    const float a = 2 * (x - std::floor(x)) - 1, b = 1 - 2 * (y - std::floor(y));
    if (y < 1) return normalised(Vec3{a, 1, b});
    if (y > 2) return normalised(Vec3{a, -1, -b});
    const Vec3 sides[]{{-1, b, -a}, {a, b, -1}, {1, b, a}, {-a, b, 1}};
    return normalised(sides[std::min(3, static_cast<int>(x))]);
  });
  expect_directions(latlong_picture(cross, EnvironmentKind::automatic), 0.999f);
}

TEST(Environment, ProportionsAreChecked) {
  EXPECT_THROW(latlong_picture(Image(300, 200, 3), EnvironmentKind::automatic), Error);
  EXPECT_THROW(latlong_picture(Image(200, 200, 3), EnvironmentKind::latlong), Error);
  EXPECT_THROW(latlong_picture(Image(400, 200, 3), EnvironmentKind::mirror_ball), Error);
  EXPECT_THROW(latlong_picture(Image(400, 200, 3), EnvironmentKind::sky_box), Error);
}

TEST(Environment, IrradianceOfAnEvenSkyAndOfHalfOne) {
  const Irradiance even = irradiance_of(Image(128, 64, 3, 0.7f));
  EXPECT_NEAR(irradiance_at(even, {0, 1, 0}).x, 0.7f, 1e-3f);
  // Bright above, black below: all of it from below it half, by the cosine: ½ (1 + n_y).
  Image half(128, 64, 3);
  std::fill(half.pixels.begin(), half.pixels.begin() + 128 * 32 * 3, 1.0f);
  const Irradiance sky = irradiance_of(half);
  EXPECT_NEAR(irradiance_at(sky, {0, 1, 0}).x, 1, 0.02f);
  EXPECT_NEAR(irradiance_at(sky, {1, 0, 0}).x, 0.5f, 0.02f);
  EXPECT_NEAR(irradiance_at(sky, {0, -1, 0}).x, 0, 0.02f);
}

}  // namespace
}  // namespace gramloom
