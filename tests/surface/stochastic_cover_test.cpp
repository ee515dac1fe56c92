// A preview's material covered without repetition.
#include "surface/stochastic_cover.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gramloom {
namespace {

// Grain that tiles: colours, a height that is their green, the height's normals in either
// convention, and a roughness of one less it.
PreviewMaterial grain(Size size, GreenAxis green = GreenAxis::up) {
  PreviewMaterial m;
  m.wraps = Tile::both;
  m.green = green;
  m.colour = Image(size, 3);
  Image height(size, 1), rough(size, 1);
  Random random(4);
  std::vector<std::array<float, 4>> waves(40);
  for (auto& wave : waves)
    for (float& value : wave) value = random.uniform();
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      double sum = 0;
      for (const auto& wave : waves) {
        const double across = std::floor(8.0 * static_cast<double>(wave[0])) - 4;
        const double down = std::floor(8.0 * static_cast<double>(wave[1])) - 4;
        sum += std::sin(
            2 * 3.14159265 *
            (across * x / size.width + down * y / size.height + static_cast<double>(wave[2])));
      }
      const auto h = static_cast<float>(0.5 + sum / 40);
      *height.at(x, y) = h;
      *rough.at(x, y) = 1 - h;
      for (int c = 0; c < 3; ++c) m.colour.at(x, y)[c] = c == 1 ? h : 0.3f;
    }
  m.maps["normal"] = normals_to_colours(normals_from_height(height, 20, Tile::both), green);
  m.maps["roughness"] = rough;
  m.maps["height"] = std::move(height);
  return m;
}

TEST(StochasticCover, MapsStayRegisteredAndNothingRepeats) {
  const PreviewMaterial m = grain({64, 64});
  const PreviewMaterial cover = covered(m, {4, 3}, 0, 4096, Random(1)).material;
  const Image& height = cover.maps.at("height");
  ASSERT_EQ(cover.colour.size(), (Size{256, 192}));
  ASSERT_EQ(height.size(), (Size{256, 192}));
  double same = 0, square = 0;
  for (int y = 0; y < 192; ++y)
    for (int x = 0; x < 256; ++x) {
      const float h = *height.at(x, y);
      ASSERT_NEAR(cover.colour.at(x, y)[1], h, 0.02f);
      ASSERT_NEAR(*cover.maps.at("roughness").at(x, y), 1 - h, 0.02f);
      const double here = static_cast<double>(h) - 0.5;
      same += here * (static_cast<double>(*height.at((x + 64) % 256, y)) - 0.5);
      square += here * here;
    }
  EXPECT_LT(same / square, 0.15);
  EXPECT_NEAR(*height.at(0, 50), *height.at(255, 50), 0.2f) << "it wraps";
}

TEST(StochasticCover, TurnedNormalsAreThoseOfTheHeightBesideThem) {
  for (const GreenAxis green : {GreenAxis::up, GreenAxis::down}) {
    const PreviewMaterial cover =
        covered(grain({64, 64}, green), {4, 4}, 180, 4096, Random(2)).material;
    EXPECT_EQ(cover.green, green);
    const Image found = colours_to_normals(cover.maps.at("normal"), cover.green);
    const Image wanted = normals_from_height(cover.maps.at("height"), 20, Tile::both);
    // The mean of the angles' cosines; where pieces are blended, normals are only nearly those.
    double same = 0, mirrored = 0;
    for (std::size_t i = 0; i < found.pixels.size(); ++i) {
      const double product = static_cast<double>(found.pixels[i] * wanted.pixels[i]);
      same += product / 65536;
      mirrored += (i % 3 == 1 ? -product : product) / 65536;
    }
    EXPECT_GT(same, 0.92) << to_word(green);
    EXPECT_LT(mirrored, 0.75) << "normals that lean";
  }
}

TEST(StochasticCover, ALargeOneIsMadeOfAReducedMaterial) {
  EXPECT_EQ(covered(grain({128, 64}), {40, 40}, 0, 1024, Random(1)).lost, 1) << "none is seen";
  EXPECT_LT(covered(grain({128, 64}), {60, 60}, 0, 65536, Random(1)).lost, 0.9);
  const PreviewMaterial cover = covered(grain({128, 64}), {40, 40}, 0, 1024, Random(1)).material;
  EXPECT_LE(cover.colour.width, 1024 + 20);
  EXPECT_GT(cover.colour.width, 900);
  EXPECT_NEAR(cover.colour.height, cover.colour.width / 2, 60);
  const Image& normals = cover.maps.at("normal");
  for (std::size_t i = 0; i < normals.pixels.size(); i += 3000) {
    double squares = 0;
    for (std::size_t c = 0; c < 3; ++c)
      squares += std::pow(2 * static_cast<double>(normals.pixels[i + c]) - 1, 2);
    ASSERT_NEAR(squares, 1, 1e-4);
  }
}

}  // namespace
}  // namespace gramloom
