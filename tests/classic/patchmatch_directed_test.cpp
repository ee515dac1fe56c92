#include <gtest/gtest.h>

#include "classic/patch_windows.h"
#include "classic/patchmatch.h"
#include "core/error.h"
#include "core/threads.h"
#include "directed_requests.h"

namespace gramloom {
namespace {

Texture optimise(const Request& request, const PatchmatchParams& params = {}) {
  return synthesise(params, request, {});
}

/// Vertical stripes of three pixels each.
Image upright_stripes(int width, int height) {
  Image image(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) *image.at(x, y) = static_cast<float>(x / 3 % 2);
  return image;
}

/// All but what lies `width` or more from every edge.
Image ring(Size size, int width) {
  return rectangle(size, width, width, size.width - 2 * width, size.height - 2 * width, 0);
}

TEST(DirectedPatchmatch, FillsWhatRepeatsExactlyAndKeepsTheRest) {
  for (const Image& picture : {stripes(96, 80, 8), upright_stripes(96, 80), chessboard(96, 80, 5),
                               chessboard(96, 80, 4), bricks(96, 80)}) {
    Image hole = rectangle(picture.size(), 30, 20, 26, 22, 1);
    for (int y = 60; y < 80; ++y)
      for (int x = 80; x < 96; ++x) *hole.at(x, y) = 1;  // at the corner
    const Texture result = optimise(fill_request(picture, hole));
    EXPECT_EQ(different(result.image, picture, hole, false), 0);
    EXPECT_EQ(different(result.image, picture, hole, true), 0);
  }
}

TEST(DirectedPatchmatch, FillsNaturalPicturesFromUsablePixelsAlone) {
  const Image picture = blobs(90, 70, 3, 5);
  Image hole = rectangle(picture.size(), 10, 12, 30, 20, 1);
  for (int y = 0; y < 70; ++y)
    for (int x = 0; x < 90; ++x)
      if (std::hypot(x - 65, y - 45) < 14) *hole.at(x, y) = 1;
  const Request request = fill_request(picture, hole);
  const Texture result = optimise(request);
  EXPECT_EQ(different(result.image, picture, hole, false), 0);
  EXPECT_EQ(masked_sources(result, request), 0);
  const Image copied = arranged(result.source, request.exemplars);
  EXPECT_EQ(different(result.image, copied, hole, true), 0);
}

TEST(DirectedPatchmatch, FillsAcrossEdgesThatMeet) {
  const Image board = chessboard(80, 60, 5);
  Request request = fill_request(board, rectangle(board.size(), 72, 0, 8, 60, 1));
  request.target.tile = Tile::x;
  EXPECT_EQ(optimise(request).image, board);
  // A window that reaches around a corner.
  const Image wide = chessboard(160, 120, 5);
  request = fill_request(wide, ring(wide.size(), 6));
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x)
      if ((x > 12 && x < 150) || (y > 12 && y < 110)) {
        *request.target.mask.at(x, y) = 0;
        *request.exemplars[0].mask.at(x, y) = 1;
        *request.target.known.at(x, y) = *request.exemplars[0].image.at(x, y) = *wide.at(x, y);
      }
  request.target.tile = Tile::both;
  EXPECT_EQ(optimise(request).image, wide);
  // A frame, which makes a picture tile.
  const Image picture = blobs(90, 80, 3, 4);
  request = fill_request(picture, ring(picture.size(), 8));
  request.target.tile = Tile::both;
  const Image tile = optimise(request).image;
  EXPECT_LT(seam_ratio(tile, true), 1.2);
  EXPECT_LT(seam_ratio(tile, false), 1.2);
  EXPECT_EQ(different(tile, picture, request.target.mask, false), 0);
}

TEST(DirectedPatchmatch, ExtendsAPictureFarBeyondItsEdges) {
  const Image picture = chessboard(40, 40, 5);
  Request request{{{picture}}, {{120, 90}}, Random(1)};
  request.target.known = chessboard(120, 90, 5);
  request.target.mask = rectangle({120, 90}, 40, 30, 40, 40, 0);
  const Image board = request.target.known;
  for (std::size_t i = 0; i < board.pixels.size(); ++i)
    if (request.target.mask.pixels[i] > 0) request.target.known.pixels[i] = 7;
  EXPECT_EQ(different(optimise(request).image, board, request.target.mask, true), 0);
}

TEST(DirectedPatchmatch, SmallTargetsAndManyHoles) {
  const Image picture = blobs(60, 50, 2, 6);
  for (const Size size : {Size{1, 1}, Size{5, 3}, Size{9, 40}, Size{20, 7}})
    for (const Tile tile : {Tile::none, Tile::x, Tile::both}) {
      Request request{{{picture}}, {size, tile}, Random(1)};
      request.target.known = Image(size, 2, 0.5f);
      request.target.mask = rectangle(size, size.width / 2, size.height / 2, 30, 30, 1);
      const Texture result = optimise(request);
      ASSERT_EQ(different(result.image, request.target.known, request.target.mask, false), 0);
      ASSERT_EQ(different(result.image, arranged(result.source, request.exemplars),
                          request.target.mask, true),
                0);
    }
  Image specks(picture.size(), 1);
  for (int y = 5; y < 50; y += 12)
    for (int x = 4; x < 60; x += 13) *specks.at(x, y) = *specks.at(x, y + 1) = 1;
  const Request request = fill_request(picture, specks);
  const Texture result = optimise(request);
  EXPECT_EQ(masked_sources(result, request), 0);
  EXPECT_EQ(different(result.image, picture, specks, false), 0);
}

TEST(DirectedPatchmatch, NeverUsesMaskedPixels) {
  Request request{{{blobs(80, 64, 2, 3)}}, {{100, 90}, Tile::both}, Random(2)};
  for (const Image& mask :
       {rectangle({80, 64}, 20, 10, 25, 30, 0), rectangle({80, 64}, 60, 40, 12, 12, 1),
        rectangle({80, 64}, 60, 40, 8, 9, 1)}) {
    request.exemplars[0].mask = mask;
    EXPECT_EQ(masked_sources(optimise(request), request), 0);
  }
}

TEST(DirectedPatchmatch, AMaskWithoutAWholePatchIsAClearError) {
  Request request{{{blobs(80, 64, 2, 3)}}, {{40, 40}}, Random(2)};
  request.exemplars[0].mask = rectangle({80, 64}, 60, 40, 30, 7, 1);
  try {
    optimise(request);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "patchmatch copies patches of 8×8 pixels: the exemplars' masks leave none whole");
  }
}

TEST(DirectedPatchmatch, HonoursLabels) {
  const Request request = label_request({100, 90});
  EXPECT_GE(honoured(optimise(request), request), 0.999);
}

TEST(DirectedPatchmatch, AWeightSaysWhereAGuideCounts) {
  Request request = label_request({100, 90});
  request.target.guide_weight = Image({100, 90}, 1);
  for (int y = 0; y < 90; ++y)
    for (int x = 50; x < 100; ++x) *request.target.guide_weight.at(x, y) = 10;
  const Texture texture = optimise(request);
  int wrong = 0;
  for (int y = 0; y < 90; ++y)
    for (int x = 50; x < 100; ++x) {
      const Source from = *texture.source.at(x, y);
      wrong += (from.x < 48) != (*request.target.guide.at(x, y) > 0.5f);
    }
  EXPECT_LT(wrong, 5);
  // Where it does not count the disc is not to be seen: about one material goes on.
  EXPECT_LT(honoured(texture, request), 0.99);
}

TEST(DirectedPatchmatch, GuidesAndFillsTogether) {
  Request request = label_request({96, 80});
  request.target.known = Image({96, 80}, 3, 0.25f);
  request.target.mask = rectangle({96, 80}, 20, 16, 56, 44, 1);
  const Texture texture = optimise(request);
  int wrong = 0;
  for (int y = 16; y < 60; ++y)
    for (int x = 20; x < 76; ++x)
      wrong += (texture.source.at(x, y)->x < 48) != (*request.target.guide.at(x, y) > 0.5f);
  EXPECT_LT(wrong, 0.01 * 56 * 44);
}

TEST(DirectedPatchmatch, UsesEveryExemplarAndMixesByWeights) {
  Request request{{{blobs(64, 50, 3, 1)}, {blobs(48, 60, 3, 2)}}, {{160, 120}}, Random(3)};
  const auto free = shares(optimise(request), 2);
  EXPECT_GT(free[0], 0.2);
  EXPECT_GT(free[1], 0.2);
  request.target.weights = Image({160, 120}, 2);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) request.target.weights.at(x, y)[x < 80 ? 0 : 1] = 1;
  request.target.guide_weight = Image(1, 1, 1, 10.0f);
  const Texture mixed = optimise(request);
  int right = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) right += mixed.source.at(x, y)->exemplar == (x < 80 ? 0u : 1u);
  EXPECT_GE(right, 0.99 * 160 * 120);
}

TEST(DirectedPatchmatch, AnyNumberOfThreadsGivesTheSameBytes) {
  const Image picture = blobs(90, 80, 3, 9);
  Request request = label_request({90, 80});
  request.target.mask = rectangle({90, 80}, 10, 10, 20, 20, 1);
  for (int y = 50; y < 70; ++y)
    for (int x = 55; x < 80; ++x) *request.target.mask.at(x, y) = 1;
  request.target.known = picture;
  const int before = thread_count();
  std::vector<Texture> results;
  for (const int threads : {1, 2, 5}) {
    set_thread_count(threads);
    results.push_back(optimise(request));
  }
  set_thread_count(before);
  for (const Texture& result : results) {
    EXPECT_EQ(result.image, results[0].image);
    EXPECT_EQ(result.source.pixels, results[0].source.pixels);
  }
}

TEST(DirectedPatchmatch, ReportsProgressAndStops) {
  const Image picture = blobs(70, 60, 3, 7);
  const Request request = fill_request(picture, rectangle(picture.size(), 20, 20, 20, 20, 1));
  std::int64_t last = 0, steps = 0;
  Control control;
  control.progress = [&](const Progress& p) {
    EXPECT_EQ(p.step, last + 1);
    EXPECT_TRUE(std::isfinite(p.loss));
    last = p.step;
    steps = p.steps;
    return true;
  };
  synthesise(PatchmatchParams{}, request, control);
  EXPECT_EQ(last, steps);
  control.progress = [](const Progress&) { return false; };
  EXPECT_THROW(synthesise(PatchmatchParams{}, request, control), Interrupted);
}

TEST(PatchWindows, HolesFarApartAreApartAndThoseAcrossAnEdgeAreNot) {
  Image mask(200, 150, 1);
  const auto dig = [&](int left, int top, int side) {
    for (int y = top; y < top + side; ++y)
      for (int x = left; x < left + side; ++x) *mask.at(x, y) = 1;
  };
  dig(0, 60, 10);
  dig(190, 62, 10);
  dig(100, 20, 12);
  const auto levels = [](int width) { return width > 10 ? 2 : 1; };
  const auto open = windows_of(mask, Tile::none, levels);
  ASSERT_EQ(open.size(), 3u);
  const auto around = windows_of(mask, Tile::x, levels);
  ASSERT_EQ(around.size(), 2u);
  for (const PatchWindow& window : around) {
    EXPECT_EQ(window.tile, Tile::none);
    const auto made = std::ranges::count(window.states, PixelState::made);
    EXPECT_EQ(made, window.levels == 2 ? 144 : 200);
    if (window.levels == 2) continue;
    EXPECT_GT(window.left, 150);
    EXPECT_GT(window.left + window.size.width, 200 + 10);
  }
}

TEST(DirectedPatchmatch, TinyPicturesOfAMaterialAreLeftOutWhereTheyAreTooNarrow) {
  Image large(128, 128, 3);
  for (std::size_t p = 0; p < large.pixels.size(); ++p)
    large.pixels[p] = static_cast<float>((p * 7919) % 101) / 101;
  const Request request{
      {{large}, {Image(1, 1, 3, 0.5f)}, {Image(1, 1, 3, 0.25f)}}, {{128, 128}}, Random(1)};
  EXPECT_NO_THROW(synthesise(PatchmatchParams{.iterations = 1}, request, {}));
}

}  // namespace
}  // namespace gramloom
