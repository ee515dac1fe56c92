#include "classic/pixel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/threads.h"

namespace gramloom {
namespace {

constexpr auto algorithms = {PixelAlgorithm::lefebvre_hoppe, PixelAlgorithm::wei_levoy,
                             PixelAlgorithm::efros_leung};
constexpr auto searches = {PixelSearch::coherence, PixelSearch::exact};

/// Smooth random blobs; every pixel differs from the others.
Image spots(Size size, int channels, std::uint64_t seed = 1) {
  Image image(size, channels);
  Random random(seed);
  for (int wave = 0; wave < 6; ++wave) {
    const float fx = random.uniform(-0.9f, 0.9f), fy = random.uniform(-0.9f, 0.9f);
    for (int c = 0; c < channels; ++c) {
      const float phase = random.uniform(0.0f, 6.28f);
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          image.at(x, y)[c] +=
              std::sin(fx * static_cast<float>(x) + fy * static_cast<float>(y) + phase);
    }
  }
  return image;
}

Image squares(Size size, int cell) {
  Image image(size, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      *image.at(x, y) = static_cast<float>((x / cell + y / cell) % 2);
  return image;
}

Image bars(Size size, int width, bool upright) {
  Image image(size, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      *image.at(x, y) = static_cast<float>((upright ? x : y) / width % 2);
  return image;
}

Image run(const PixelParams& params, const Image& exemplar, const Target& target,
          std::uint64_t seed = 1) {
  return synthesise(params, {{{exemplar}}, target, Random(seed)}, {}).image;
}

using Pixel = std::vector<float>;
std::set<Pixel> pixels_of(const Image& image) {
  std::set<Pixel> pixels;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      pixels.insert(Pixel(image.at(x, y), image.at(x, y) + image.channels));
  return pixels;
}

class EachWay : public testing::TestWithParam<std::tuple<PixelAlgorithm, PixelSearch>> {
 protected:
  PixelParams params() const {
    PixelParams p;
    std::tie(p.algorithm, p.search) = GetParam();
    return p;
  }
};
INSTANTIATE_TEST_SUITE_P(Pixel, EachWay,
                         testing::Combine(testing::ValuesIn(algorithms),
                                          testing::ValuesIn(searches)),
                         [](const auto& way) {
                           return std::string(to_word(std::get<0>(way.param))) + "_" +
                                  std::string(to_word(std::get<1>(way.param)));
                         });

TEST_P(EachWay, ResultPixelsAreExemplarPixels) {
  const Image exemplar = spots({24, 20}, 3);
  const Image result = run(params(), exemplar, {{40, 30}, Tile::x});
  EXPECT_EQ(result.size(), (Size{40, 30}));
  const auto known = pixels_of(exemplar);
  const auto found = pixels_of(result);
  EXPECT_TRUE(std::includes(known.begin(), known.end(), found.begin(), found.end()));
  EXPECT_GT(found.size(), 50u);  // and not always the same one
}

TEST_P(EachWay, SameBytesForAnyNumberOfThreads) {
  const Image exemplar = spots({30, 26}, 2);
  const Target target{{33, 41}, Tile::both};
  std::vector<Image> results;
  for (const int threads : {1, 2, 8}) {
    set_thread_count(threads);
    results.push_back(run(params(), exemplar, target));
  }
  set_thread_count(0);
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
  EXPECT_NE(results[0], run(params(), exemplar, target, 2));
}

TEST_P(EachWay, ChessboardContinuesExactly) {
  const int cell = 3;
  const Image result = run(params(), squares({24, 24}, cell), {{37, 32}, Tile::none});
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      if (x >= cell) {
        ASSERT_EQ(*result.at(x, y), 1 - *result.at(x - cell, y)) << x << ", " << y;
      }
      if (y >= cell) {
        ASSERT_EQ(*result.at(x, y), 1 - *result.at(x, y - cell)) << x << ", " << y;
      }
    }
}

TEST_P(EachWay, StripesContinueExactly) {
  const int width = 3;
  for (const bool upright : {false, true}) {
    const Image result = run(params(), bars({24, 24}, width, upright), {{37, 32}, Tile::none});
    const int dx = upright ? width : 0, dy = upright ? 0 : width;
    for (int y = 0; y < result.height; ++y)
      for (int x = 0; x < result.width; ++x) {
        if (x >= dx && y >= dy) {
          ASSERT_EQ(*result.at(x, y), 1 - *result.at(x - dx, y - dy)) << x << ", " << y;
        }
        if ((upright ? y : x) > 0) {
          ASSERT_EQ(*result.at(x, y), *result.at(x - !upright, y - upright)) << x << ", " << y;
        }
      }
  }
}

/// Mean square step between columns x − 1 and x (rows if !columns).
double step_across(const Image& image, int at, bool columns) {
  const int count = columns ? image.height : image.width;
  const int last = (columns ? image.width : image.height);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const float* a =
        columns ? image.at((at + last - 1) % last, i) : image.at(i, (at + last - 1) % last);
    const float* b = columns ? image.at(at, i) : image.at(i, at);
    for (int c = 0; c < image.channels; ++c)
      sum += static_cast<double>((a[c] - b[c]) * (a[c] - b[c]));
  }
  return sum / count;
}

TEST_P(EachWay, EdgesMeetWhereAsked) {
  const Image exemplar = spots({40, 36}, 1);
  for (const Tile tile : {Tile::x, Tile::y, Tile::both}) {
    const Image result = run(params(), exemplar, {{50, 44}, tile});
    for (const bool columns : {true, false}) {
      if (columns ? !tiles_x(tile) : !tiles_y(tile)) continue;
      std::vector<double> inside;
      for (int i = 1; i < (columns ? result.width : result.height); ++i)
        inside.push_back(step_across(result, i, columns));
      std::sort(inside.begin(), inside.end());
      // No worse than the steps within the picture, but for their roughest tenth.
      EXPECT_LE(step_across(result, 0, columns), 1.5 * inside[inside.size() * 9 / 10])
          << "tile " << static_cast<int>(tile) << (columns ? " x" : " y");
    }
  }
}

TEST_P(EachWay, TinyExemplarsAndResults) {
  for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{2, 2}, Size{3, 5}}) {
    const Image exemplar = spots(size, 2);
    const auto known = pixels_of(exemplar);
    for (const Target& target : {Target{{1, 1}, Tile::both}, Target{{1, 6}, Tile::x},
                                 Target{{12, 10}, Tile::none}, Target{{11, 3}, Tile::both}}) {
      const Image result = run(params(), exemplar, target);
      EXPECT_EQ(result.size(), target.size);
      for (const auto& pixel : pixels_of(result)) EXPECT_TRUE(known.contains(pixel));
    }
  }
}

TEST_P(EachWay, ConstantStaysConstant) {
  const Image exemplar(20, 16, 3, 0.25f);
  EXPECT_EQ(run(params(), exemplar, {{21, 23}, Tile::both}), Image(21, 23, 3, 0.25f));
}

TEST_P(EachWay, StopsWhenAsked) {
  const Image exemplar = spots({24, 24}, 1);
  int calls = 0;
  Control control;
  control.progress = [&](const Progress&) { return ++calls < 2; };
  EXPECT_THROW(synthesise(params(), {{{exemplar}}, {{24, 24}, Tile::none}, Random(1)}, control),
               Interrupted);
  EXPECT_EQ(calls, 2);
}

TEST_P(EachWay, ProgressRisesToItsEnd) {
  const Image exemplar = spots({24, 24}, 1);
  Progress last;
  Control control;
  control.progress = [&](const Progress& p) {
    EXPECT_GE(p.step, last.step);
    EXPECT_LE(p.step, p.steps);
    last = p;
    return true;
  };
  synthesise(params(), {{{exemplar}}, {{20, 30}, Tile::none}, Random(1)}, control);
  EXPECT_EQ(last.step, last.steps);
}

TEST(Pixel, AnyNumberOfChannels) {
  for (const int channels : {1, 4, 5, 8, 64})
    for (const PixelAlgorithm algorithm : algorithms) {
      PixelParams params;
      params.algorithm = algorithm;
      const Image result = run(params, spots({16, 18}, channels), {{12, 20}, Tile::y});
      EXPECT_EQ(result.channels, channels);
    }
}

TEST(Pixel, JitterAndLevelsAndTheGreatestRadius) {
  PixelParams params;
  params.radius = 15;
  params.levels = 12;
  params.jitter = 1;
  params.candidates = 16;
  const Image exemplar = spots({20, 24}, 4);
  const auto known = pixels_of(exemplar);
  for (const PixelAlgorithm algorithm : algorithms) {
    params.algorithm = algorithm;
    for (const auto& pixel : pixels_of(run(params, exemplar, {{30, 17}, Tile::both})))
      EXPECT_TRUE(known.contains(pixel));
  }
}

TEST(Pixel, RefusesWhatItCannotUse) {
  EXPECT_THROW(run({}, Image(), {{8, 8}, Tile::none}), Error);
  EXPECT_THROW(run({}, Image(4, 4, 65), {{8, 8}, Tile::none}), Error);
  EXPECT_THROW(run({}, Image(4, 4, 1, NAN), {{8, 8}, Tile::none}), Error);
  EXPECT_THROW(run({}, Image(4, 4, 1), {{0, 8}, Tile::none}), Error);
  PixelParams params;
  params.radius = 0;
  EXPECT_THROW(run(params, Image(4, 4, 1), {{8, 8}, Tile::none}), ConfigError);
}

}  // namespace
}  // namespace gramloom
