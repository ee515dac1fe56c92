#include "surface/tiling.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/neighbour.h"
#include "core/threads.h"
#include "surface/normal_map.h"
#include "surface/stochastic_tiling.h"

namespace gramloom {
namespace {

// Blurred noise that tiles, its distribution askew; channels differ, and go together in part.
Image skewed_noise(Size size, int channels, std::uint64_t seed = 1) {
  Image noise(size, channels);
  Random random(seed);
  for (float& value : noise.pixels) value = random.normal();
  for (int pass = 0; pass < 3; ++pass) {
    const Image before = noise;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        for (int c = 0; c < channels; ++c) {
          float sum = 0;
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
              sum += before.at(neighbour(x + dx, size.width, true),
                               neighbour(y + dy, size.height, true))[c];
          noise.at(x, y)[c] = sum / 4;
        }
  }
  Image skewed = noise;
  for (std::size_t i = 0; i < noise.pixels.size(); ++i) {
    const auto c = i % static_cast<std::size_t>(channels);
    const float own = noise.pixels[i], first = noise.pixels[i - c];
    skewed.pixels[i] = 1 / (1 + std::exp(1 - 0.7f * (0.6f * own + 0.8f * first)));
  }
  return skewed;
}

std::vector<float> channel(const Image& image, int c) {
  std::vector<float> values;
  for (std::size_t i = static_cast<std::size_t>(c); i < image.pixels.size();
       i += static_cast<std::size_t>(image.channels))
    values.push_back(image.pixels[i]);
  return values;
}

struct Moments {
  double mean, deviation;
};
Moments moments(const std::vector<float>& values) {
  double sum = 0, squares = 0;
  for (const float value : values) {
    sum += static_cast<double>(value);
    squares += static_cast<double>(value) * static_cast<double>(value);
  }
  const double mean = sum / static_cast<double>(values.size());
  return {mean, std::sqrt(squares / static_cast<double>(values.size()) - mean * mean)};
}

float quantile(std::vector<float> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Of the first channel with itself, shifted.
double autocorrelation(const Image& image, int dx, int dy) {
  std::vector<float> here, there;
  for (int y = 0; y + dy < image.height; ++y)
    for (int x = 0; x + dx < image.width; ++x) {
      here.push_back(*image.at(x, y));
      there.push_back(*image.at(x + dx, y + dy));
    }
  const Moments a = moments(here), b = moments(there);
  double product = 0;
  for (std::size_t i = 0; i < here.size(); ++i)
    product += (static_cast<double>(here[i]) - a.mean) * (static_cast<double>(there[i]) - b.mean);
  return product / static_cast<double>(here.size()) / (a.deviation * b.deviation);
}

Image tiled(const Exemplar& exemplar, const TilingParams& params, Size size,
            Tile tile = Tile::none) {
  return synthesise(params, {{exemplar}, {size, tile}, Random(1)}, {}).image;
}

TEST(Tiling, KeepsMeanDeviationAndHistogram) {
  const Image exemplar = skewed_noise({96, 96}, 3);
  for (const Tile wraps : {Tile::both, Tile::none})
    for (const double sharpness : {1.0, 4.0})
      for (const double rotation : {0.0, 180.0}) {
        SCOPED_TRACE(fmt::format("sharpness {}, rotation {}", sharpness, rotation));
        const Image result = tiled(
            {exemplar}, {.cell = 0.2, .sharpness = sharpness, .rotation = rotation, .wraps = wraps},
            {400, 400});
        for (int c = 0; c < 3; ++c) {
          const auto before = channel(exemplar, c), after = channel(result, c);
          const Moments wanted = moments(before), found = moments(after);
          EXPECT_NEAR(found.mean, wanted.mean, 0.1 * wanted.deviation);
          EXPECT_NEAR(found.deviation / wanted.deviation, 1, 0.08);
          for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95})
            EXPECT_NEAR(quantile(after, share), quantile(before, share), 0.16 * wanted.deviation)
                << share;
        }
      }
}

// Averaging would leave √(Σw²) of it: ¾ on the whole.
TEST(Tiling, BlendingLosesNoContrastWherePiecesMeet) {
  const Image exemplar = skewed_noise({96, 96}, 1);
  const TilingParams params{.sharpness = 1, .wraps = Tile::both};
  const StochasticTiling tiling({exemplar}, params, Random(1));
  const TilingLattice lattice({exemplar.size(), Tile::both, {}, Tile::none, 24, 0}, Random(1));
  std::vector<float> middle;  // of triangles, where three pieces have a third each
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 60; ++column) {
      float value = 0;
      tiling.at(lattice.across() * (column + 0.5 * row + 0.5), lattice.down() * (row + 1.0 / 3),
                &value);
      middle.push_back(value);
    }
  const Moments wanted = moments(exemplar.pixels), found = moments(middle);
  EXPECT_NEAR(found.deviation / wanted.deviation, 1, 0.05);
  EXPECT_NEAR(found.mean, wanted.mean, 0.06 * wanted.deviation);
}

TEST(Tiling, HasNoPeriod) {
  const Image exemplar = skewed_noise({64, 64}, 1);
  Image repeated({384, 384}, 1);
  for (int y = 0; y < 384; ++y)
    for (int x = 0; x < 384; ++x) *repeated.at(x, y) = *exemplar.at(x % 64, y % 64);
  ASSERT_NEAR(autocorrelation(repeated, 64, 0), 1, 1e-6);
  for (const Tile wraps : {Tile::both, Tile::none})
    for (const TileBlend blend : {TileBlend::histogram, TileBlend::contrast}) {
      const Image result = tiled({exemplar}, {.blend = blend, .wraps = wraps}, {384, 384});
      for (const int shift : {64, 128, 16, 32, 48}) {
        EXPECT_LT(autocorrelation(result, shift, 0), 0.1) << shift;
        EXPECT_LT(autocorrelation(result, 0, shift), 0.1) << shift;
        EXPECT_LT(autocorrelation(result, shift, shift), 0.1) << shift;
      }
      EXPECT_NEAR(autocorrelation(result, 1, 0), autocorrelation(exemplar, 1, 0), 0.03)
          << "neighbours stay neighbours";
    }
}

// A colour, a height that it tells, and the height's normals.
Exemplar material(Size size, GreenAxis green = GreenAxis::up) {
  const Image height = skewed_noise(size, 1);
  const Image normals = normals_to_colours(normals_from_height(height, 6, Tile::both), green);
  Exemplar exemplar{Image(size, 7),
                    {{"", MapKind::colour, 0, 3},
                     {"height", MapKind::scalar, 3, 1},
                     {"normal", MapKind::normal, 4, 3, green}}};
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const float h = *height.at(x, y);
      const float* n = normals.at(x, y);
      const float values[] = {h, 0.2f + 0.5f * h, 1 - h, h, n[0], n[1], n[2]};
      std::copy(std::begin(values), std::end(values), exemplar.image.at(x, y));
    }
  return exemplar;
}

TEST(Tiling, MapsStayRegistered) {
  const Exemplar exemplar = material({96, 80});
  for (const TileBlend blend : {TileBlend::histogram, TileBlend::contrast})
    for (const double rotation : {0.0, 90.0}) {
      const Image result =
          tiled(exemplar, {.blend = blend, .rotation = rotation, .wraps = Tile::both}, {300, 280});
      for (std::size_t i = 0; i < result.pixels.size(); i += 7) {
        const float* pixel = result.pixels.data() + i;
        ASSERT_NEAR(pixel[3], pixel[0], 0.02f);
        ASSERT_NEAR(pixel[2], 1 - pixel[3], 0.02f);
        double squares = 0;
        for (int c = 4; c < 7; ++c) squares += std::pow(2 * static_cast<double>(pixel[c]) - 1, 2);
        ASSERT_NEAR(squares, 1, 1e-5) << "of unit length";
      }
    }
}

// Where hardly anything is blended, normals must be those of the heights beside them.
TEST(Tiling, NormalsTurnWithTheirPieces) {
  for (const GreenAxis green : {GreenAxis::up, GreenAxis::down}) {
    const Image result =
        tiled(material({96, 80}, green),
              {.blend = TileBlend::contrast, .sharpness = 64, .rotation = 180, .wraps = Tile::both},
              {300, 280});
    const Image found = colours_to_normals(extract_channels(result, 4, 3), green);
    const Image wanted = normals_from_height(extract_channels(result, 3, 1), 6, Tile::none);
    std::vector<float> cosines;
    for (std::size_t i = 0; i < found.pixels.size(); i += 3)
      cosines.push_back(found.pixels[i] * wanted.pixels[i] +
                        found.pixels[i + 1] * wanted.pixels[i + 1] +
                        found.pixels[i + 2] * wanted.pixels[i + 2]);
    EXPECT_GT(quantile(cosines, 0.5), 0.995) << to_word(green);
    EXPECT_GT(quantile(cosines, 0.2), 0.98) << to_word(green);
  }
}

TEST(Tiling, RowsAndPointsAreThoseOfTheWhole) {
  const Exemplar exemplar = material({50, 61});
  for (const TilingParams& params :
       {TilingParams{}, TilingParams{.blend = TileBlend::contrast, .wraps = Tile::x},
        TilingParams{.rotation = 30, .wraps = Tile::both}})
    for (const Tile tile : {Tile::none, Tile::both}) {
      const Size size{173, 90};
      const Image whole = tiled(exemplar, params, size, tile);
      const StochasticTiling tiling(exemplar, params, size, tile, Random(1));
      for (const int threads : {1, 3}) {
        set_thread_count(threads);
        Image rows(size, 7);
        for (int y = 0; y < size.height; y += 7)
          tiling.rows(y, std::min(7, size.height - y), size.width, rows.at(0, y));
        EXPECT_EQ(rows, whole);
      }
      set_thread_count(0);
      for (int y = 0; y < size.height; y += 5)
        for (int x = 0; x < size.width; x += 3) {
          std::array<float, 7> values{};
          tiling.at(x + 0.5, y + 0.5, values.data());
          for (std::size_t c = 0; c < 7; ++c)
            ASSERT_NEAR(values[c], whole.at(x, y)[c], 1e-3f) << x << ", " << y << ", " << c;
        }
    }
}

TEST(Tiling, ComesBackAfterItsSizeWhereItTiles) {
  const Exemplar exemplar = material({64, 48});
  for (const double rotation : {0.0, 45.0}) {
    const Size size{150, 130};
    const StochasticTiling tiling(exemplar, {.rotation = rotation}, size, Tile::both, Random(3));
    std::array<float, 7> here{}, there{};
    for (double x = -40.3; x < 60; x += 9.1)
      for (double y = -50.7; y < 60; y += 7.3) {
        tiling.at(x, y, here.data());
        for (const auto& [dx, dy] : {std::pair{150, 0}, {0, 130}, {-300, 390}}) {
          tiling.at(x + dx, y + dy, there.data());
          for (std::size_t c = 0; c < 7; ++c) ASSERT_NEAR(here[c], there[c], 1e-4f);
        }
      }
  }
}

TEST(TilingLattice, PiecesLieInsideAnExemplarThatDoesNotWrap) {
  for (const Size exemplar : {Size{100, 100}, Size{64, 200}, Size{33, 20}})
    for (const double rotation : {0.0, 180.0}) {
      const double side = 0.5 * std::min(exemplar.width, exemplar.height);
      const TilingLattice lattice({exemplar, Tile::none, {1, 1}, Tile::none, side, rotation},
                                  Random(5));
      for (double x = -500.5; x < 500; x += 7)
        for (double y = -300.5; y < 300; y += 5)
          for (const TilingCorner& corner : lattice.around(x, y)) {
            ASSERT_GE(corner.weight, 0);
            const TilingPiece piece = lattice.piece(corner.column, corner.row);
            const double from_x = piece.cosine * x - piece.sine * y + piece.x0;
            const double from_y = piece.sine * x + piece.cosine * y + piece.y0;
            ASSERT_GE(from_x, -1e-9);
            ASSERT_GE(from_y, -1e-9);
            ASSERT_LE(from_x, exemplar.width + 1e-9);
            ASSERT_LE(from_y, exemplar.height + 1e-9);
          }
    }
}

TEST(TilingLattice, WeightsAreTheSharesOfThePointsAround) {
  const TilingLattice lattice({{99, 99}, Tile::none, {}, Tile::none, 10, 0}, Random(1));
  for (double x = -31; x < 30; x += 1.7)
    for (double y = -27; y < 30; y += 1.3) {
      double sum = 0, at_x = 0, at_y = 0;
      for (const TilingCorner& corner : lattice.around(x, y)) {
        sum += corner.weight;
        at_x += corner.weight * lattice.across() *
                (static_cast<double>(corner.column) + static_cast<double>(corner.row) / 2);
        at_y += corner.weight * lattice.down() * static_cast<double>(corner.row);
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      EXPECT_NEAR(at_x, x, 1e-10);
      EXPECT_NEAR(at_y, y, 1e-10);
    }
}

TEST(Tiling, MovedByWholePeriodsAPatternGoesOn) {
  Image bricks({64, 48}, 3);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c)
        bricks.at(x, y)[c] = (x + 8 * (y / 12)) % 16 < 3 || y % 12 < 2 ? 0.9f : 0.2f;
  for (const Tile wraps : {Tile::none, Tile::both}) {
    const Image wall = tiled({bricks}, {.wraps = wraps, .period = {16, 24}}, {200, 150});
    for (int y = 0; y < 150; ++y)
      for (int x = 0; x < 200; ++x)
        ASSERT_NEAR(*wall.at(x, y), *bricks.at(x % 64, y % 48), 1e-5f) << x << ", " << y;
  }
}

TEST(Tiling, RefusesWhatExcludesItself) {
  const Exemplar exemplar{skewed_noise({32, 32}, 1)};
  EXPECT_THAT(
      [&] {
        tiled(exemplar, {.period = {8}}, {40, 40});
      },
      testing::ThrowsMessage<Error>("period has 1 numbers: two are needed, across and down"));
  EXPECT_THAT(
      [&] {
        tiled(exemplar, {.rotation = 5, .period = {8, 8}}, {40, 40});
      },
      testing::ThrowsMessage<Error>("period and rotation: only one of them may be given"));
}

TEST(Tiling, RefusesPeriodsAndCellsThatLeavePiecesNoChoice) {
  const Exemplar exemplar{skewed_noise({32, 40}, 1)};
  const auto refusal = [&](const TilingParams& params) -> std::string {
    std::string made, estimated;
    try {
      tiled(exemplar, params, {40, 40});
    } catch (const Error& error) {
      made = error.what();
    }
    try {
      estimate(params, {.exemplars = {{{32, 40}, 1}}, .size = {40, 40}});
    } catch (const Error& error) {
      estimated = error.what();
    }
    EXPECT_EQ(made, estimated) << "the estimate knows it";
    return made;
  };
  // Sides of 8: pieces of 17 × 14 pixels, 16 × 27 places.
  EXPECT_EQ(refusal({.period = {8, 27}}), "");
  EXPECT_EQ(refusal({.period = {15, 27}}), "");
  EXPECT_EQ(refusal({.period = {15, 26}}), "") << "some pieces have two places";
  EXPECT_THAT(refusal({.period = {16, 27}}),
              testing::HasSubstr("every piece would be from the same place"));
  EXPECT_EQ(refusal({.period = {17, 8}}),
            "period = 17 across: pieces of 17 pixels have only 16 places that way, so no multiple "
            "fits some of them; choose a smaller cell or a period up to 16");
  EXPECT_THAT(refusal({.period = {8, 28}}), testing::HasSubstr("period = 28 down: pieces of 14"));
  EXPECT_EQ(refusal({.period = {14.5, 8}}), "");
  EXPECT_NE(refusal({.period = {15.5, 8}}), "") << "rounded, 16 apart and one more";
  EXPECT_EQ(refusal({.wraps = Tile::both, .period = {32, 20}}), "");
  EXPECT_EQ(refusal({.wraps = Tile::both, .period = {32, 40}}),
            "period = 32,40: every piece would be from the same place of the picture of 32×40 "
            "pixels, which would only be repeated; choose a shorter period, or a larger picture");
  EXPECT_EQ(refusal({.cell = 0.45}), "");
  EXPECT_EQ(refusal({.cell = 0.5, .wraps = Tile::both}), "");
  EXPECT_EQ(refusal({.cell = 0.5}), "") << "it is higher than wide";
  const Exemplar square{skewed_noise({32, 32}, 1)};
  for (const double rotation : {0.0, 90.0})
    EXPECT_THAT(
        [&] {
          tiled(square, {.cell = 0.5, .rotation = rotation}, {40, 40});
        },
        testing::ThrowsMessage<Error>(
            testing::HasSubstr("places in an exemplar of 32×32, so all would be nearly the same")))
        << rotation;
}

}  // namespace
}  // namespace gramloom
