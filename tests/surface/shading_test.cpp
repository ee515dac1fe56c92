#include "surface/shading.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace gramloom {
namespace {

const Vec3 up{0, 0, 1};

Vec3 tilted(float degrees, float turn = 0) {
  const float a = degrees * pi / 180;
  return {std::sin(a) * std::cos(turn), std::sin(a) * std::sin(turn), std::cos(a)};
}

TEST(Shading, LambertIsTheCosine) {
  const Material m{.shading = Shading::lambert, .colour = {1, 0.5f, 0.25f}};
  EXPECT_NEAR(shade(m, up, tilted(60), tilted(10)).x, 0.5f, 1e-6f);
  EXPECT_NEAR(shade(m, up, tilted(60), tilted(80)).y, 0.25f, 1e-6f);
  EXPECT_EQ(shade(m, up, tilted(91), up), Vec3{});
}

TEST(Shading, PhongAddsAHighlightAroundTheMirroredLight) {
  const Material m{
      .shading = Shading::phong, .colour = {0, 0, 0}, .specular = 0.5f, .shininess = 8};
  EXPECT_NEAR(shade(m, up, tilted(30), tilted(-30)).x, 0.5f, 1e-6f);
  EXPECT_NEAR(shade(m, up, tilted(30), up).x, 0.5f * std::pow(std::cos(pi / 6), 8.0f), 1e-6f);
  EXPECT_EQ(shade(m, up, tilted(80), tilted(80)).x, 0);
}

// The light that leaves in all directions, of light that comes from one: at most all of it. By
// reciprocity that which comes from all directions and leaves in one.
double reflected(const Material& m, const Vec3& view) {
  Random random(3);
  constexpr int count = 40000;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    // Evenly over the half-sphere: a light of strength 1 from a solid angle dω gives 1/π dω.
    const float z = random.uniform(), turn = 2 * pi * random.uniform();
    const float r = std::sqrt(1 - z * z);
    sum += static_cast<double>(shade(m, up, {r * std::cos(turn), r * std::sin(turn), z}, view).x);
  }
  return 2 * sum / count;
}

TEST(Shading, MetalGivesNoMoreLightThanComes) {
  for (const float roughness : {0.3f, 0.6f, 1.0f})
    for (const float metalness : {0.0f, 0.5f, 1.0f})
      for (const float angle : {0.0f, 45.0f, 80.0f}) {
        const Material m{.roughness = roughness, .metalness = metalness};
        const double all = reflected(m, tilted(angle));
        EXPECT_LT(all, 1.03) << roughness << " " << metalness << " " << angle;
        EXPECT_GT(all, 0.3) << roughness << " " << metalness << " " << angle;
      }
  // A fairly smooth metal loses little.
  EXPECT_NEAR(reflected({.roughness = 0.3f, .metalness = 1}, up), 1, 0.04);
}

TEST(Shading, MetalUnderAnEvenSkyIsNoBrighterThanIt) {
  for (const float roughness : {0.0f, 0.5f, 1.0f})
    for (const float metalness : {0.0f, 1.0f})
      for (const float angle : {0.0f, 45.0f, 85.0f}) {
        const Material m{.roughness = roughness, .metalness = metalness};
        const float all = shade_environment(m, up, tilted(angle), {1, 1, 1}, {1, 1, 1}).x;
        EXPECT_LE(all, 1.02f) << roughness << " " << metalness << " " << angle;
        EXPECT_GT(all, 0.44f) << roughness << " " << metalness << " " << angle;
      }
}

TEST(Shading, MetalHasNoDiffuseLightAndItsHighlightsItsColour) {
  const Material m{.colour = {1, 0.5f, 0}, .roughness = 0.2f, .metalness = 1};
  const Vec3 light = shade(m, up, tilted(30), tilted(-30));
  EXPECT_GT(light.x, 1);
  EXPECT_NEAR(light.y / light.x, 0.5f, 0.01f);
  EXPECT_LT(shade(m, up, tilted(30), tilted(60)).x, 1e-2f);
}

TEST(Shading, SrgbAndBack) {
  for (const float v : {0.0f, 0.002f, 0.04f, 0.2f, 0.5f, 1.0f})
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(v)), v, 1e-6f);
  EXPECT_NEAR(linear_from_srgb(0.5f), 0.21404f, 1e-5f);
}

}  // namespace
}  // namespace gramloom
