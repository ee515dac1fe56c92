#include "procedural/solid.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace gramloom {
namespace {

TEST(Solid, APointIsThatOfThePictureAtItsDepth) {
  for (const ProceduralTexture& texture : {ProceduralTexture(Marble{}), ProceduralTexture(Wood{}),
                                           ProceduralTexture(Checkerboard{})}) {
    ProceduralParams params;
    params.texture = texture;
    params.samples = 1;
    params.scale = 4;
    params.depth = 1.25;
    const Random random(5);
    const Texture picture =
        synthesise(params, {.target = {{32, 32}, Tile::none}, .random = random}, {});
    std::vector<std::array<float, 3>> points;
    const float step = 4.0f / 32;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        points.push_back(
            {(static_cast<float>(x) + 0.5f) * step, (static_cast<float>(y) + 0.5f) * step, 1.25f});
    params.depth = 0;
    const Image at = colours_at(params, points, step, random);
    ASSERT_EQ(at.pixels.size(), picture.image.pixels.size());
    int differ = 0;
    for (std::size_t i = 0; i < at.pixels.size(); ++i)
      differ += std::abs(at.pixels[i] - picture.image.pixels[i]) > 0.02f;
    EXPECT_LT(differ, 30);
  }
}

TEST(Solid, FlatTexturesAreRefused) {
  ProceduralParams params;
  params.texture = Brick{};
  EXPECT_THROW(colours_at(params, {}, 0, Random(1)), ConfigError);
  params.texture = Marble{};
  EXPECT_TRUE(colours_at(params, {}, 0, Random(1)).empty());
}

}  // namespace
}  // namespace gramloom
