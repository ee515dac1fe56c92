#include "classic/quilting.h"

#include <gtest/gtest.h>

#include "core/threads.h"
#include "patch_exemplars.h"

namespace gramloom {
namespace {

Image quilt(const QuiltingParams& params, const Image& exemplar, const Target& target,
            std::uint64_t seed = 1) {
  return synthesise(params, {{{exemplar}}, target, Random(seed)}, {}).image;
}

TEST(Quilting, EveryPixelIsOneOfTheExemplars) {
  const Image exemplar = blobs(60, 50, 3, 1);
  const auto known = colours(exemplar);
  for (const Tile tile : {Tile::none, Tile::x, Tile::y, Tile::both}) {
    const Image result = quilt({.patch_size = 18}, exemplar, {{93, 71}, tile});
    EXPECT_EQ(result.size(), (Size{93, 71}));
    for (const auto& colour : colours(result)) ASSERT_TRUE(known.contains(colour));
  }
}

TEST(Quilting, ContinuesAChessboardExactly) {
  const Image exemplar = chessboard(40, 40, 4);
  for (const Tile tile : {Tile::none, Tile::both}) {
    const Image result =
        quilt({.patch_size = 20, .overlap = 0.4, .tolerance = 0}, exemplar, {{96, 80}, tile});
    const int left = tile == Tile::none ? 92 : 96, top = tile == Tile::none ? 76 : 80;
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 96; ++x) {
        if (x < left) {
          ASSERT_NE(*result.at(x, y), *result.at((x + 4) % 96, y)) << x << ' ' << y;
        }
        if (y < top) {
          ASSERT_NE(*result.at(x, y), *result.at(x, (y + 4) % 80)) << x << ' ' << y;
        }
      }
  }
}

TEST(Quilting, TilesAcrossTheSeam) {
  const Image exemplar = blobs(96, 96, 3, 2);
  const QuiltingParams params{.patch_size = 24, .overlap = 0.25};
  for (const Tile tile : {Tile::x, Tile::y, Tile::both}) {
    const Image result = quilt(params, exemplar, {{120, 104}, tile});
    if (tiles_x(tile)) {
      EXPECT_LT(seam_ratio(result, true), 1);
    }
    if (tiles_y(tile)) {
      EXPECT_LT(seam_ratio(result, false), 1);
    }
  }
  // The measure sees a seam where there is one.
  const Image open = quilt(params, exemplar, {{120, 104}, Tile::none});
  EXPECT_GT(seam_ratio(open, true), 3);
  EXPECT_GT(seam_ratio(open, false), 3);
}

TEST(Quilting, FeatheringStaysInTheExemplarsRangeAndOnlyTouchesOverlaps) {
  const Image exemplar = blobs(64, 64, 2, 3);
  // One column of two patches that overlap in rows 18 to 23, not cut from one piece. What is above
  // and below comes from one patch alone, whatever the feather.
  const QuiltingParams sharp{.patch_size = 24, .overlap = 0.25, .variety = 100};
  QuiltingParams blended = sharp;
  blended.feather = 2;
  const Target target{{24, 42}, Tile::none};
  const Image cut = quilt(sharp, exemplar, target);
  const Image soft = quilt(blended, exemplar, target);
  const ChannelRange range = channel_range(exemplar);
  bool overlap_differs = false;
  for (int y = 0; y < 42; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 2; ++c) {
        const float a = cut.at(x, y)[c], b = soft.at(x, y)[c];
        EXPECT_GE(b, range.low[static_cast<std::size_t>(c)]);
        EXPECT_LE(b, range.high[static_cast<std::size_t>(c)]);
        if (y < 18 || y >= 24)
          ASSERT_EQ(a, b) << x << ' ' << y;
        else
          overlap_differs |= a != b;
      }
  EXPECT_TRUE(overlap_differs);
}

TEST(Quilting, SameBytesForAnyNumberOfThreads) {
  const Image exemplar = blobs(70, 60, 3, 4);
  for (const Tile tile : {Tile::none, Tile::both}) {
    std::vector<Image> results;
    for (const int threads : {1, 2, 8}) {
      set_thread_count(threads);
      results.push_back(quilt({.patch_size = 20}, exemplar, {{150, 130}, tile}));
    }
    set_thread_count(0);
    EXPECT_EQ(results[0], results[1]);
    EXPECT_EQ(results[0], results[2]);
    EXPECT_NE(results[0], quilt({.patch_size = 20}, exemplar, {{150, 130}, tile}, 2));
  }
}

/// Bricks of 48 × 16 pixels in mortar of 3, with a little grain; odd rows are shifted by half.
Image square_bricks(int side) {
  Image image(side, side, 1);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int row = y / 16, column = (x + row % 2 * 24) / 48;
      const bool mortar = y % 16 < 3 || (x + row % 2 * 24) % 48 < 3;
      Random brick(3, static_cast<std::uint64_t>(row * 64 + column));
      Random grain(4, static_cast<std::uint64_t>(y * side + x));
      *image.at(x, y) = (mortar ? 1.0f : 0.3f + 0.1f * brick.uniform()) + 0.05f * grain.uniform();
    }
  return image;
}

TEST(Quilting, DefaultsKeepTheCoursesOfBricksStraight) {
  const Image exemplar = square_bricks(96);
  for (const Tile tile : {Tile::none, Tile::both})
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
      const Image wall = quilt({}, exemplar, {{192, 192}, tile}, seed);
      // Rows of pixels are bed joints, mortar throughout, or none; courses lie 16 rows apart.
      std::vector<int> joints;
      for (int y = 0; y < 192; ++y) {
        int mortar = 0;
        for (int x = 0; x < 192; ++x) mortar += *wall.at(x, y) > 0.7f ? 1 : 0;
        if (mortar > 180) joints.push_back(y);
      }
      ASSERT_EQ(joints.size(), 36u) << "seed " << seed;
      for (std::size_t i = 3; i < joints.size(); ++i)
        EXPECT_EQ(joints[i] - joints[i - 3], 16) << "seed " << seed;
    }
}

TEST(Quilting, VarietyUsesMoreOfTheExemplar) {
  const Image exemplar = blobs(96, 96, 1, 9);
  const auto used = [&](double variety) {
    return colours(quilt({.variety = variety, .guidance = 0}, exemplar, {{192, 192}})).size();
  };
  EXPECT_GT(used(0.3), used(0));
}

TEST(Quilting, SmallExemplarsAndTargets) {
  for (const Size size : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{2, 2}, Size{5, 3}, Size{20, 7}})
    for (const Size wanted : {Size{1, 1}, Size{2, 3}, Size{7, 40}, Size{33, 5}})
      for (const Tile tile : {Tile::none, Tile::x, Tile::y, Tile::both}) {
        const Image exemplar = blobs(size.width, size.height, 2, 5);
        const auto known = colours(exemplar);
        const Image result = quilt({}, exemplar, {wanted, tile});
        ASSERT_EQ(result.size(), wanted);
        for (const auto& colour : colours(result)) ASSERT_TRUE(known.contains(colour));
      }
}

TEST(Quilting, ManyChannels) {
  const Image exemplar = blobs(40, 40, 64, 6);
  EXPECT_EQ(quilt({.patch_size = 16}, exemplar, {{50, 50}, Tile::both}).channels, 64);
}

TEST(Quilting, ReportsProgressAndStops) {
  const Image exemplar = blobs(50, 50, 1, 7);
  std::int64_t calls = 0, last = -1, steps = 0;
  Control control;
  control.progress = [&](const Progress& p) {
    ++calls;
    EXPECT_GT(p.step, last);
    last = p.step;
    steps = p.steps;
    return true;
  };
  synthesise(QuiltingParams{.patch_size = 16}, {{{exemplar}}, {{90, 90}, Tile::none}, Random(1)},
             control);
  EXPECT_GT(calls, 3);
  EXPECT_EQ(last, steps);
  control.progress = [](const Progress&) { return false; };
  EXPECT_THROW(
      synthesise(QuiltingParams{}, {{{exemplar}}, {{90, 90}, Tile::none}, Random(1)}, control),
      Interrupted);
}

TEST(Quilting, RefusesWhatCannotBe) {
  const Image exemplar = blobs(10, 10, 1, 8);
  EXPECT_THROW(quilt({.patch_size = -1}, exemplar, {}), ConfigError);
  EXPECT_THROW(quilt({.overlap = 0.6}, exemplar, {}), ConfigError);
  EXPECT_THROW(quilt({}, Image(), {}), Error);
  EXPECT_THROW(quilt({}, exemplar, {{0, 5}, Tile::none}), Error);
}

}  // namespace
}  // namespace gramloom
