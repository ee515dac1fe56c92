#include "metrics/copying.h"

#include <gtest/gtest.h>

#include <cmath>

#include "metrics/controls.h"
#include "metrics/pictures.h"
#include "signal/nearest_patches.h"

namespace gramloom {
namespace {

/// To 8 bits and with the noise of a strong JPEG.
Image encoded_again(const Image& image) {
  Image result = noisy(blurred(image, 0.4), 0.015f);
  for (float& v : result.pixels) v = std::round(v * 255) / 255;
  return result;
}

TEST(Copying, AShiftedCropIsAllCopied) {
  for (const Image& exemplar : {pebbles(), brick(), stones()})
    for (const Image& crop :
         {window(exemplar, 20, 9, {90, 80}), encoded_again(window(exemplar, 20, 9, {90, 80}))}) {
      const Scores scores = score(exemplar, crop, Tile::none);
      EXPECT_GT(value(scores, "copied_share"), 0.99);
      EXPECT_GT(value(scores, "copy_coherence"), 0.95);
      EXPECT_GT(value(scores, "copy_correlation"), 0.95);
    }
}

TEST(Copying, ATiledCopyIsCaught) {
  for (const Image& exemplar : {pebbles(), stones()}) {
    // The exemplar itself has wrapped edges; a window of it has none.
    const Image piece = window(exemplar, 0, 0, {100, 90});
    const ControlPair tiled = control_pair(ControlKind::tiled, piece, {250, 220}, Random(1));
    const Scores scores = score(tiled.exemplar, tiled.image, Tile::none);
    // Blocks lie 4 pixels apart: up to 3 pixels on each side of a seam are in none that is copied.
    EXPECT_GT(value(scores, "copied_share"), 0.97);
    EXPECT_GT(value(scores, "copy_correlation"), 0.99);
    EXPECT_GT(value(scores, "repetition"), 0.5);
    EXPECT_LT(value(score(piece, quilted(exemplar, {250, 220}), Tile::none), "repetition"),
              0.5 * value(scores, "repetition"));
  }
}

TEST(Copying, AnotherSampleOfTheTextureIsNotCopied) {
  for (const auto& [exemplar, other] :
       {std::pair{pebbles(), pebbles(2)}, std::pair{stones(), stones(2)}}) {
    const Scores scores = score(exemplar, other, Tile::none);
    EXPECT_LT(value(scores, "copied_share"), 0.15);
    EXPECT_LT(value(scores, "copy_coherence"), 0.7);
    EXPECT_LT(value(scores, "copy_correlation"), 0.6);
  }
}

TEST(Copying, OnePieceAmongOriginalsIsFoundWhereItIs) {
  const Image exemplar = pebbles();
  Image image = pebbles(2);
  const Image piece = window(exemplar, 60, 50, {40, 32});
  for (int y = 0; y < piece.height; ++y)
    std::copy_n(piece.at(0, y), piece.width * piece.channels, image.at(24, 70 + y));
  const Scores scores = score(exemplar, image, Tile::none);
  const double area = 40.0 * 32 / (128 * 128);
  EXPECT_GT(value(scores, "copied_share"), 0.9 * area);
  // The middle of the piece is (20, 16) into it: in the exemplar at (80, 66), in the image at
  // (44, 86).
  const float* colour = scores.copy_map.at(44, 86);
  EXPECT_NEAR(colour[0], 80.0 / 127, 1e-5);
  EXPECT_NEAR(colour[1], 66.0 / 127, 1e-5);
  EXPECT_NEAR(colour[2], 1 - (80 + 66) / 2.0 / 127, 1e-5);
}

TEST(Copying, AFlatImageSaysNothing) {
  const Scores scores = score(pebbles(), Image(64, 64, 3, 0.5f), Tile::none);
  EXPECT_EQ(value(scores, "copied_share"), 0);
  EXPECT_EQ(value(scores, "copy_correlation"), 0);
}

TEST(Copying, TheSearchIsCloseToTryingAll) {
  const Image exemplar = grain({40, 36}, 4, 1), image = grain({30, 28}, 4, 2);
  const PatchField found = nearest_patches(image, exemplar, PatchTree(exemplar));
  PatchField best = found;
  search_all(best, image, exemplar, PatchPenalty(found.size, patch_origins(exemplar.size())));
  double sum_found = 0, sum_best = 0;
  for (std::size_t i = 0; i < best.distance.size(); ++i) {
    ASSERT_GE(found.distance[i], best.distance[i]);
    sum_found += double{found.distance[i]};
    sum_best += double{best.distance[i]};
  }
  EXPECT_LT(sum_found, 1.15 * sum_best);  // white noise: nothing leads to the best
}

TEST(Copying, WhatIsExactlyThereIsFound) {
  const Image exemplar = grain({90, 80}, 4, 1);
  const PatchField field =
      nearest_patches(window(exemplar, 13, 21, {50, 40}), exemplar, PatchTree(exemplar));
  for (int y = 0; y < field.size.height; ++y)
    for (int x = 0; x < field.size.width; ++x)
      ASSERT_EQ(field.nearest[field.index(x, y)], (PatchOrigin{x + 13, y + 21}));
}

}  // namespace
}  // namespace gramloom
