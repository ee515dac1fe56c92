#include <gtest/gtest.h>

#include "classic/pixel.h"
#include "core/error.h"
#include "core/threads.h"
#include "directed_requests.h"

namespace gramloom {
namespace {

Texture pixels(const Request& request, const PixelParams& params = {}) {
  return synthesise(params, request, {});
}

TEST(DirectedPixel, FillsWhatRepeatsExactlyAndKeepsTheRest) {
  for (const Image& picture : {stripes(96, 80, 8), chessboard(96, 80, 5), bricks(96, 80)}) {
    Image hole = rectangle(picture.size(), 30, 20, 26, 22, 1);
    for (int y = 60; y < 80; ++y)
      for (int x = 80; x < 96; ++x) *hole.at(x, y) = 1;  // at the corner
    const Texture result = pixels(fill_request(picture, hole));
    EXPECT_EQ(different(result.image, picture, hole, false), 0);
    EXPECT_EQ(different(result.image, picture, hole, true), 0);
  }
}

// The ring that says in which phase a pattern goes on reaches beyond the exemplar then.
TEST(DirectedPixel, LargeHolesInSmallExemplarsGoOnInPhase) {
  const auto wall = [](Size size) {
    Image image(size, 1);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        *image.at(x, y) = y % 12 < 2 || (x + y / 12 % 2 * 12) % 24 < 2 ? 0.1f : 0.9f;
    return image;
  };
  const Image picture = wall({256, 256});
  const Image hole = rectangle(picture.size(), 64, 64, 128, 128, 1);
  EXPECT_EQ(synthesise(PixelParams{}, fill_request(picture, hole), {}).image, picture);

  Request from = fill_request(picture, rectangle(picture.size(), 100, 100, 24, 24, 1));
  from.exemplars = {{wall({60, 52})}};
  EXPECT_EQ(synthesise(PixelParams{}, from, {}).image, picture);
}

TEST(DirectedPixel, FillsNaturalPicturesFromUsablePixelsAlone) {
  const Image picture = blobs(90, 70, 3, 5);
  Image hole = rectangle(picture.size(), 10, 12, 30, 20, 1);
  for (int y = 0; y < 70; ++y)
    for (int x = 0; x < 90; ++x)
      if (std::hypot(x - 65, y - 45) < 14) *hole.at(x, y) = 1;
  for (const auto algorithm : {PixelAlgorithm::lefebvre_hoppe, PixelAlgorithm::efros_leung}) {
    const Request request = fill_request(picture, hole);
    const Texture result = pixels(request, {.algorithm = algorithm});
    EXPECT_EQ(different(result.image, picture, hole, false), 0);
    EXPECT_EQ(masked_sources(result, request), 0);
    const Image copied = arranged(result.source, request.exemplars);
    EXPECT_EQ(different(result.image, copied, hole, true), 0);
  }
}

TEST(DirectedPixel, FillsAcrossEdgesThatMeet) {
  const Image picture = chessboard(80, 60, 5);
  Image hole = rectangle(picture.size(), 72, 0, 8, 60, 1);
  Request request = fill_request(picture, hole);
  request.target.tile = Tile::x;
  EXPECT_EQ(different(pixels(request).image, picture, hole, true), 0);
}

TEST(DirectedPixel, NeverUsesMaskedPixels) {
  Request request{{{blobs(80, 64, 2, 3)}}, {{100, 90}, Tile::both}, Random(2)};
  request.exemplars[0].mask = rectangle({80, 64}, 20, 10, 25, 30, 0);
  for (const auto algorithm :
       {PixelAlgorithm::lefebvre_hoppe, PixelAlgorithm::wei_levoy, PixelAlgorithm::efros_leung})
    for (const PixelSearch search : {PixelSearch::coherence, PixelSearch::exact}) {
      request.target.size = search == PixelSearch::exact ? Size{24, 20} : Size{60, 50};
      const PixelParams params{.algorithm = algorithm, .search = search, .jitter = 0.5};
      request.exemplars[0].mask = rectangle({80, 64}, 20, 10, 25, 30, 0);
      EXPECT_EQ(masked_sources(pixels(request, params), request), 0);
      request.exemplars[0].mask = rectangle({80, 64}, 60, 41, 3, 1, 1);  // hardly anything is left
      EXPECT_EQ(masked_sources(pixels(request, params), request), 0);
    }
}

TEST(DirectedPixel, HonoursLabels) {
  for (const auto algorithm :
       {PixelAlgorithm::lefebvre_hoppe, PixelAlgorithm::wei_levoy, PixelAlgorithm::efros_leung}) {
    const Request request = label_request({60, 50});
    EXPECT_GE(honoured(pixels(request, {.algorithm = algorithm}), request), 0.995);
  }
}

TEST(DirectedPixel, UsesEveryExemplarAndMixesByWeights) {
  Request request{{{blobs(64, 50, 3, 1)}, {blobs(48, 60, 3, 2)}}, {{160, 120}}, Random(3)};
  const auto free = shares(pixels(request), 2);
  EXPECT_GT(free[0], 0.25);
  EXPECT_GT(free[1], 0.25);
  request.target.weights = Image(1, 1, 2, 1.0f);
  request.target.weights.pixels[0] = 4;
  EXPECT_NEAR(shares(pixels(request), 2)[0], 0.8, 0.15);
  request.target.weights = Image({160, 120}, 2);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) request.target.weights.at(x, y)[x < 80 ? 0 : 1] = 1;
  request.target.guide_weight = Image(1, 1, 1, 10.0f);
  const Texture mixed = pixels(request);
  int right = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) right += mixed.source.at(x, y)->exemplar == (x < 80 ? 0u : 1u);
  EXPECT_GE(right, 0.99 * 160 * 120);
}

TEST(DirectedPixel, WhatAnAlgorithmCannotDoIsRefused) {
  const Image picture = blobs(40, 40, 1, 1);
  const Request request = fill_request(picture, rectangle({40, 40}, 10, 10, 9, 9, 1));
  const PixelParams params{.algorithm = PixelAlgorithm::wei_levoy};
  EXPECT_THROW(pixels(request, params), Error);
  EXPECT_THROW(estimate(params, size_of(request)), Error);
}

TEST(DirectedPixel, AnyNumberOfThreadsGivesTheSameBytes) {
  Request request = label_request({90, 80});
  request.target.mask = rectangle({90, 80}, 10, 10, 60, 50, 1);
  request.target.known = blobs(90, 80, 3, 9);
  const int before = thread_count();
  set_thread_count(1);
  const Texture one = pixels(request);
  set_thread_count(5);
  const Texture five = pixels(request);
  set_thread_count(before);
  EXPECT_EQ(one.image, five.image);
  EXPECT_EQ(one.source.pixels, five.source.pixels);
}

}  // namespace
}  // namespace gramloom
