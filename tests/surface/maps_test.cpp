// The maps that a config or the command line asks for.
#include "surface/maps.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "surface/relief_maps.h"

namespace gramloom {
namespace {

TEST(MapsOfHeight, AreThoseAskedForAsTheyStandInFiles) {
  Image height({16, 12}, 1);
  for (std::size_t i = 0; i < height.pixels.size(); ++i)
    height.pixels[i] = static_cast<float>(i * 7 % 11) / 11;
  EXPECT_TRUE(maps_of_height(height, {}, Tile::both).empty());
  MapParams params{.normal = true, .occlusion = true, .curvature = true};
  params.green = GreenAxis::down;
  EXPECT_EQ(maps_asked(params), (std::vector<std::string>{"normal", "occlusion", "curvature"}));
  const auto maps = maps_of_height(height, params, Tile::both);
  EXPECT_EQ(maps.size(), 3u);
  EXPECT_EQ(maps.at("normal"),
            normals_to_colours(normals_from_height(height, 8, Tile::both), GreenAxis::down));
  EXPECT_EQ(maps.at("occlusion"), ambient_occlusion(height, 8, 32, 8, Tile::both));
  EXPECT_EQ(maps.at("curvature"), curvature(height, 8, 4, 2, Tile::both));
  params.strength = 0;
  EXPECT_THROW(maps_of_height(height, params, Tile::both), ConfigError);
}

TEST(MapsOfHeight, GreyInColoursIsAHeightAndColoursAreNot) {
  Image grey({2, 2}, 3);
  grey.pixels = {.1f, .1f, .1f, .5f, .51f, .5f, 1, 1, 1, 0, 0, 0};
  EXPECT_EQ(one_channel(grey).pixels, (std::vector<float>{.1f, .5f, 1, 0}));
  grey.pixels[4] = .6f;
  EXPECT_THROW(one_channel(grey), Error);
  EXPECT_EQ(one_channel(Image({2, 2}, 1, 0.3f)), Image({2, 2}, 1, 0.3f));
}

}  // namespace
}  // namespace gramloom
