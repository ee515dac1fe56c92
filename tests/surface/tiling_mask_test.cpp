#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/neighbour.h"
#include "surface/stochastic_tiling.h"

namespace gramloom {
namespace {

Image mask_of(Size size) {
  Image mask(size, 1, 1.0f);
  for (int y = 12; y < 30; ++y)
    for (int x = 30; x < 55; ++x) *mask.at(x, y) = 0;
  return mask;
}

TEST(MaskedTiling, PiecesLieInUsablePixels) {
  const Size size{100, 80};
  const Image mask = mask_of(size);
  for (const TilingParams& params :
       {TilingParams{.cell = 0.1}, TilingParams{.cell = 0.1, .wraps = Tile::both},
        TilingParams{.cell = 0.08, .rotation = 90}, TilingParams{.cell = 0.1, .period = {16, 10}}})
    for (const Tile tile : {Tile::none, Tile::both}) {
      const TilingLattice lattice = make_lattice(params, size, {90, 70}, tile, Random(1), mask);
      for (int y = 0; y < 70; ++y)
        for (int x = 0; x < 90; ++x)
          for (const TilingCorner& corner : lattice.around(x + 0.5, y + 0.5)) {
            const TilingPiece piece = lattice.piece(corner.column, corner.row);
            const double from_x = piece.cosine * (x + 0.5) - piece.sine * (y + 0.5) + piece.x0;
            const double from_y = piece.sine * (x + 0.5) + piece.cosine * (y + 0.5) + piece.y0;
            ASSERT_EQ(*mask.at(neighbour(static_cast<int>(std::floor(from_x)), size.width,
                                         tiles_x(params.wraps)),
                               neighbour(static_cast<int>(std::floor(from_y)), size.height,
                                         tiles_y(params.wraps))),
                      1.0f)
                << params.rotation << ' ' << x << ' ' << y;
          }
    }
}

TEST(MaskedTiling, MaskedPixelsDoNotCount) {
  const Size size{100, 80};
  Random random(2);
  Exemplar exemplar{Image(size, 3), {}, mask_of(size)};
  for (std::size_t i = 0; i < exemplar.image.pixels.size(); ++i)
    exemplar.image.pixels[i] = exemplar.mask.pixels[i / 3] > 0.5f ? random.uniform() : 40.0f;
  Exemplar other = exemplar;
  for (std::size_t i = 0; i < other.image.pixels.size(); ++i)
    if (other.mask.pixels[i / 3] < 0.5f) other.image.pixels[i] = -7;
  for (const TilingParams& params :
       {TilingParams{.cell = 0.1}, TilingParams{.cell = 0.1, .blend = TileBlend::contrast},
        TilingParams{.cell = 0.08, .rotation = 45}}) {
    const Image image = synthesise(params, {{exemplar}, {{120, 90}}, Random(3)}, {}).image;
    for (const float value : image.pixels) ASSERT_TRUE(value >= 0 && value <= 1);
    EXPECT_EQ(image, synthesise(params, {{other}, {{120, 90}}, Random(3)}, {}).image);
  }
}

TEST(MaskedTiling, AMaskWithoutRoomForAPieceIsRefused) {
  Exemplar exemplar{Image(100, 80, 1, 0.5f), {}, Image(100, 80, 1, 0.0f)};
  *exemplar.mask.at(50, 40) = 1;
  EXPECT_THROW(synthesise(TilingParams{}, {{exemplar}, {{120, 90}}, Random(3)}, {}), Error);
}

}  // namespace
}  // namespace gramloom
