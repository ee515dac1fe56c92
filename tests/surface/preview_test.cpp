#include "surface/preview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "core/error.h"
#include "core/threads.h"
#include "surface/preview_mapping.h"

namespace gramloom {
namespace {

// A white ball, lit by a lamp alone, on nothing.
PreviewParams lit_ball() {
  PreviewParams p;
  p.size = {96, 96};
  p.samples = 1;
  p.shading = Shading::lambert;
  p.light = {30, 40};
  p.light_size = 0;
  p.light_strength = 1;
  p.light_colour = {1, 1, 1};
  p.environment_strength = 0;
  p.ground = false;
  p.background = Background::transparent;
  return p;
}

Image render(const PreviewParams& p, const PreviewMaterial& material = {},
             const Image& environment = {}) {
  return render_preview(p, {&material, 1}, environment, {}).picture;
}

// Where the ray through a pixel's middle meets the unit ball.
std::optional<Vec3> on_ball(const Camera& camera, int x, int y) {
  const Ray ray = camera.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const float b = dot(ray.origin, ray.direction);
  const float root = b * b - dot(ray.origin, ray.origin) + 1;
  // Not so near the rim that the facets' outline counts.
  if (root < 0.02f) return std::nullopt;
  return ray.origin + ray.direction * (-b - std::sqrt(root));
}

// The pixel in which a point is seen.
std::pair<int, int> seen_at(const Camera& camera, const Vec3& p) {
  const Vec3 d = p - camera.origin;
  const Vec3 right = normalised(camera.right), down = normalised(camera.down);
  const Vec3 ahead = cross(down, right) * -1.0f;
  const float scale = dot(camera.corner, ahead) / dot(d, ahead);
  const Vec3 from_corner = d * scale - camera.corner;
  return {static_cast<int>(dot(from_corner, right) / length(camera.right)),
          static_cast<int>(dot(from_corner, down) / length(camera.down))};
}

template <class Expected>
void expect_ball(const PreviewParams& p, const PreviewMaterial& material, float tolerance,
                 Expected&& expected) {
  const Image picture = render(p, material);
  const Camera camera = preview_camera(p);
  int seen = 0;
  for (int y = 0; y < p.size.height; ++y)
    for (int x = 0; x < p.size.width; ++x)
      if (const auto n = on_ball(camera, x, y)) {
        const Vec3 view = normalised(camera.origin - *n);
        EXPECT_NEAR(picture.at(x, y)[0], expected(*n, view), tolerance) << x << ", " << y;
        EXPECT_EQ(picture.at(x, y)[3], 1);
        ++seen;
      }
  EXPECT_GT(seen, 2000);
}

TEST(Preview, AWhiteLambertBallIsTheCosine) {
  const PreviewParams p = lit_ball();
  const Vec3 light = direction_of(30, 40);
  expect_ball(p, {}, 3e-3f,
              [&](const Vec3& n, const Vec3&) { return std::max(0.0f, dot(n, light)); });
}

TEST(Preview, AWhitePhongBallHasItsHighlight) {
  PreviewParams p = lit_ball();
  p.shading = Shading::phong;
  p.specular = 0.5;
  p.shininess = 10;
  const Vec3 light = direction_of(30, 40);
  expect_ball(p, {}, 0.02f, [&](const Vec3& n, const Vec3& view) {
    const float nl = dot(n, light);
    if (nl <= 0) return 0.0f;
    return nl + 0.5f * std::pow(std::max(0.0f, dot(mirrored(light, n), view)), 10.0f);
  });
}

TEST(Preview, AWhiteBallInAnEvenSkyIsEven) {
  PreviewParams p = lit_ball();
  p.light_strength = 0;
  p.environment_strength = 0.8;
  const Image picture = render(p, {}, Image(64, 32, 3, 0.5f));
  const auto [x, y] = seen_at(preview_camera(p), {0.2f, 0.1f, 0.95f});
  EXPECT_NEAR(picture.at(x, y)[1], 0.4f, 1e-3f);
}

// One stone on each of 4 × 4 squares.
PreviewMaterial stones() {
  PreviewMaterial m;
  m.colour = Image(64, 64, 3, 0.6f);
  Image& height = m.maps["height"] = Image(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const auto dx = static_cast<float>(x % 16) - 7.5f, dy = static_cast<float>(y % 16) - 7.5f;
      *height.at(x, y) = std::max(0.0f, 1 - (dx * dx + dy * dy) / 60);
    }
  return m;
}

TEST(Preview, DisplacementByZeroEqualsNone) {
  PreviewParams p = lit_ball();
  p.bump = 0;
  PreviewMaterial bare = stones();
  bare.maps.clear();
  EXPECT_EQ(render(p, stones()), render(p, bare));
}

double covered(const Image& picture) {
  double sum = 0;
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4)
    sum += static_cast<double>(picture.pixels[i]);
  return sum;
}

TEST(Preview, DisplacementChangesTheOutlineAndBumpsDoNot) {
  PreviewParams p = lit_ball();
  p.samples = 2;
  const double flat = covered(render(p, {}));
  p.bump = 0.2;
  EXPECT_EQ(covered(render(p, stones())), flat);
  p.bump = 0;
  p.displacement = 0.2;
  const double moved = covered(render(p, stones()));
  EXPECT_GT(moved, 1.05 * flat);
  EXPECT_LT(moved, 1.44 * flat);
  // A height of 1 everywhere makes a larger ball.
  PreviewMaterial even = stones();
  even.maps["height"] = Image(64, 64, 1, 1);
  p.displacement = 0.1;
  const double distance = static_cast<double>(length(preview_camera(p).origin));
  const auto apparent = [&](double r) { return r * r / (distance * distance - r * r); };
  EXPECT_NEAR(covered(render(p, even)) / flat, apparent(1.1) / apparent(1), 0.01);
}

TEST(Preview, ShadowsFallIntoGrooves) {
  PreviewParams p = lit_ball();
  p.light = {50, 20};
  p.samples = 2;
  p.bump = 0;
  // A groove along the middle, deep and narrow: lit from the side its floor is dark.
  PreviewMaterial m;
  m.colour = Image(64, 64, 3, 1);
  m.maps["height"] = Image(64, 64, 1, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 30; x < 34; ++x) *m.maps["height"].at(x, y) = 0;
  p.repeat = {3, 1};  // one of them in front
  p.displacement = 0.2;
  p.lookup = Lookup::bilinear;
  p.detail = 1;
  const auto [x, y] = seen_at(preview_camera(p), {0, 0, 1});
  EXPECT_LT(render(p, m).at(x, y)[0], 0.05f);
  p.displacement = 0;
  EXPECT_GT(render(p, m).at(x, y)[0], 0.5f);
}

TEST(Preview, TheShadowOfABoxIsAtItsPlace) {
  PreviewParams p = lit_ball();
  p.shape = "cube";
  p.ground = true;
  p.background = Background::studio;
  p.light = {90, 45};  // from the right
  p.view = {0, 60};
  p.zoom = 0.4;
  const Image picture = render(p);
  const Camera camera = preview_camera(p);
  const auto brightness = [&](float x, float z) {
    const auto [i, j] = seen_at(camera, {x, -0.7f, z});
    return picture.at(i, j)[0];
  };
  // 1.4 high and lit at 45°: the shadow reaches 1.4 to the left of the side at −0.7.
  EXPECT_LT(brightness(-1.95f, 0), 0.01f);
  EXPECT_GT(brightness(-2.25f, 0), 0.3f);
  EXPECT_LT(brightness(-1.5f, 0.62f), 0.01f);
  EXPECT_GT(brightness(-1.5f, 0.8f), 0.3f);
  EXPECT_GT(brightness(1.5f, 0), 0.3f);
}

TEST(Preview, AMirrorShowsThePhotographOfAMirrorBall) {
  PreviewParams p = lit_ball();
  p.shading = Shading::metal;
  p.roughness = 0;
  p.metalness = 1;
  p.light_strength = 0;
  p.environment_strength = 1;
  p.view = {0, 0};
  p.environment_kind = EnvironmentKind::mirror_ball;
  // Red grows to the right, green upwards.
  Image photo(256, 256, 3);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      photo.at(x, y)[0] = (static_cast<float>(x) + 0.5f) / 256;
      photo.at(x, y)[1] = 1 - (static_cast<float>(y) + 0.5f) / 256;
    }
  const Image picture = render(p, {}, photo);
  const Camera camera = preview_camera(p);
  for (const Vec3 n : {Vec3{0, 0, 1}, Vec3{0.5f, 0, 0.87f}, Vec3{-0.3f, 0.5f, 0.81f}}) {
    const auto [x, y] = seen_at(camera, n);
    // The ball is seen from nearby, the photograph from far away: a few degrees.
    EXPECT_NEAR(picture.at(x, y)[0], 0.5f * (n.x + 1), 0.06f);
    EXPECT_NEAR(picture.at(x, y)[1], 0.5f * (n.y + 1), 0.06f);
  }
}

TEST(Preview, TheSameBytesForAnyThreads) {
  PreviewParams p;
  p.size = {64, 48};
  p.samples = 2;
  p.displacement = 0.1;
  set_thread_count(1);
  const Image one = render(p, stones());
  for (const int threads : {2, 4}) {
    set_thread_count(threads);
    EXPECT_EQ(render(p, stones()), one) << threads;
  }
  set_thread_count(0);
}

TEST(Preview, TwoMaterialsShareAShapeByAPattern) {
  PreviewParams p = lit_ball();
  p.shape = "plane";
  p.view = {0, 90};
  p.light = {0, 90};
  p.pattern_repeat = 1;  // two squares along the plane
  std::vector<PreviewMaterial> both(2);
  both[0].colour = Image(4, 4, 3, 1);
  both[1].colour = Image(4, 4, 3, 0.25f);
  const Image picture = render_preview(p, both, {}, {}).picture;
  const Camera camera = preview_camera(p);
  const auto at = [&](float x, float z) {
    const auto [i, j] = seen_at(camera, {x, 0, z});
    return picture.at(i, j)[0];
  };
  EXPECT_NEAR(at(-0.5f, 0.5f), 1, 1e-3f);
  EXPECT_NEAR(at(0.5f, 0.5f), 0.25f, 1e-3f);
  EXPECT_NEAR(at(0.5f, -0.5f), 1, 1e-3f);
}

TEST(Preview, ASolidIsAskedAtThePointItself) {
  PreviewParams p = lit_ball();
  p.mapping = Mapping::solid;
  p.light = {0, 14};
  PreviewMaterial m;
  m.solid = [](std::span<const Vec3> points, float, std::span<Vec3> colours) {
    std::copy(points.begin(), points.end(), colours.begin());
  };
  const Image picture = render(p, m);
  const Vec3 n = normalised({0.4f, 0.3f, 0.8f});
  const auto [x, y] = seen_at(preview_camera(p), n);
  const float cosine = dot(n, direction_of(0, 14));
  EXPECT_NEAR(picture.at(x, y)[0], cosine * 0.5f * (n.x + 1), 0.01f);
  EXPECT_NEAR(picture.at(x, y)[1], cosine * 0.5f * (n.y + 1), 0.01f);
  EXPECT_NEAR(picture.at(x, y)[2], cosine * 0.5f * (n.z + 1), 0.01f);
}

TEST(Preview, AFlatNormalMapChangesNothingAndATiltedOneTurnsTheLight) {
  PreviewParams p = lit_ball();
  p.shape = "plane";
  p.view = {0, 90};
  p.light = {90, 45};  // from the right, where u grows
  PreviewMaterial m;
  const auto with_normal = [&](float r, float g, float b) {
    Image& map = m.maps["normal"] = Image(4, 4, 3);
    for (std::size_t i = 0; i < map.pixels.size(); i += 3) {
      map.pixels[i] = r;
      map.pixels[i + 1] = g;
      map.pixels[i + 2] = b;
    }
    return render(p, m).at(48, 48)[0];
  };
  EXPECT_NEAR(with_normal(0.5f, 0.5f, 1), std::sqrt(0.5f), 1e-3f);
  const float half = 0.5f + 0.5f * std::sqrt(0.5f);
  EXPECT_NEAR(with_normal(half, 0.5f, half), 1, 1e-3f);      // faces the lamp
  EXPECT_NEAR(with_normal(1 - half, 0.5f, half), 0, 1e-3f);  // at right angles to it
  p.light = {180, 45};                                       // from behind, where v grows
  EXPECT_NEAR(with_normal(0.5f, half, half), 1, 1e-3f);
  m.green = GreenAxis::down;
  EXPECT_NEAR(with_normal(0.5f, half, half), 0, 1e-3f);
  p.green = GreenAxis::up;
  EXPECT_NEAR(with_normal(0.5f, half, half), 1, 1e-3f) << "the params first";
}

TEST(Preview, ABumpIsTheNormalOfItsHeight) {
  PreviewParams p = lit_ball();
  p.shape = "plane";
  p.view = {0, 90};
  p.light = {90, 45};
  p.repeat = {1, 1};
  p.outside = Outside::clamp;
  // A ramp that rises by 1 over the picture, which is 2 wide, falls away from the lamp on the
  // right.
  PreviewMaterial m;
  Image& height = m.maps["height"] = Image(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) *height.at(x, y) = static_cast<float>(x) / 64;
  p.bump = 1;
  const Vec3 normal = normalised({-0.5f, 1, 0});
  EXPECT_NEAR(render(p, m).at(48, 48)[0], dot(normal, direction_of(90, 45)), 2e-3f);
}

// A row of squares that repeat is the same after one of them; covered stochastically it is not.
TEST(Preview, AStochasticFloorHasNoPeriod) {
  PreviewParams p = lit_ball();
  p.shape = "plane";
  p.view = {0, 90};
  p.light = {0, 90};
  p.size = {256, 256};
  p.repeat = {4};
  PreviewMaterial m;
  m.colour = Image(48, 48, 3);
  std::vector<float> spots(16 * 16);
  Random random(1);
  for (float& spot : spots) spot = random.uniform();
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x)
      for (int c = 0; c < 3; ++c)
        m.colour.at(x, y)[c] = spots[static_cast<std::size_t>(16 * (y / 3) + x / 3)];
  const Camera camera = preview_camera(p);
  const auto difference = [&] {
    const Image picture = render(p, m);
    double sum = 0;
    for (float z = -0.95f; z < 0.95f; z += 0.1f)
      for (float x = -0.95f; x < 0.4f; x += 0.1f) {
        const auto [a, b] = seen_at(camera, {x, 0, z});
        const auto [c, d] = seen_at(camera, {x + 0.5f, 0, z});  // a quarter of its width
        sum += static_cast<double>(std::abs(picture.at(a, b)[0] - picture.at(c, d)[0]));
      }
    return sum / 19 / 14;
  };
  const double repeated = difference();
  p.stochastic = true;
  EXPECT_GT(difference(), 2 * repeated + 0.05);
}

TEST(Preview, AStochasticHeightMovesTheOutlineAndTheSlopesWithIt) {
  PreviewParams p = lit_ball();
  p.samples = 2;
  p.bump = 0;
  p.displacement = 0.2;
  const Image straight = render(p, stones());
  p.stochastic = true;
  p.stochastic_rotation = 90;
  const Image covered_ball = render(p, stones());
  EXPECT_NE(covered_ball, straight);
  EXPECT_NEAR(covered(covered_ball) / covered(straight), 1, 0.06);
  set_thread_count(1);
  EXPECT_EQ(render(p, stones()), covered_ball) << "for any threads";
  set_thread_count(0);
}

std::string refusal(const PreviewParams& p, const PreviewMaterial& m = {},
                    const Image& environment = {}) {
  try {
    render(p, m, environment);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Preview, WhatCannotBeShownIsToldInALine) {
  using testing::HasSubstr;
  const PreviewParams good = lit_ball();
  PreviewParams p = good;
  p.shape = "spere";
  EXPECT_EQ(refusal(p),
            "unknown shape 'spere' (did you mean 'sphere'?): allowed are sphere, plane, cube, "
            "cylinder, teapot, tube, or a file (*.obj)");
  PreviewMaterial m = stones();
  m.maps["roughness"] = Image(32, 64, 1);
  EXPECT_EQ(refusal(good, m),
            "the map 'roughness' has 32×64 pixels and the picture 64×64: they must be alike");
  m = stones();
  m.maps["height"] = Image(64, 64, 3);
  EXPECT_EQ(refusal(good, m), "the map 'height' has 3 channels, it needs 1");
  m = stones();
  m.maps["gloss"] = Image(64, 64, 1);
  EXPECT_THAT(refusal(good, m), HasSubstr("unknown map 'gloss'"));
  EXPECT_THAT(refusal(good, {}, Image(300, 200, 3)),
              HasSubstr("an environment of 300×200 pixels: allowed are twice as wide as high"));
  p = good;
  p.samples = 0;
  EXPECT_THAT(refusal(p), HasSubstr("samples = 0: allowed are 1 to 16"));
  p = good;
  p.light = {1, 2, 3};
  EXPECT_EQ(refusal(p), "light has 3 numbers: allowed are 2");
  p = good;
  p.mapping = Mapping::solid;
  EXPECT_THAT(refusal(p, stones()), HasSubstr("needs a solid texture or a stack of slices"));
  p.stochastic = true;
  EXPECT_EQ(refusal(p, stones()), "stochastic: a solid is not repeated");
  p = good;
  p.stochastic_rotation = 5;
  EXPECT_EQ(refusal(p), "stochastic_rotation = 5: has no effect without stochastic");
  p.stochastic = true;
  p.outside = Outside::clamp;
  EXPECT_EQ(refusal(p), "stochastic: what is outside the picture must be 'tile', not 'clamp'");
}

}  // namespace
}  // namespace gramloom
