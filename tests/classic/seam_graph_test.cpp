#include "classic/seam_graph.h"

#include <gtest/gtest.h>

namespace gramloom {
namespace {

TEST(SeamGraph, FollowsWhereBothAgreeAndKeepsWhatIsFirm) {
  // Firm on the left, laid in the middle, bare on the right; both agree along a staircase alone.
  constexpr int width = 12, height = 9;
  Image old(width, height, 1, 0.0f), fresh(width, height, 1, 1.0f);
  std::vector<Ground> ground((width + 2) * (height + 2), Ground::bare);
  const auto step_at = [](int y) { return 4 + y / 3; };
  for (int y = 0; y < height; ++y) {
    for (const int x : {step_at(y), step_at(y) + 1}) *fresh.at(x, y) = 0;
    for (int x = 0; x < 10; ++x)
      ground[static_cast<std::size_t>((y + 1) * (width + 2) + x + 1)] =
          x < 2 ? Ground::firm : Ground::laid;
  }
  const PatchCut cut = graph_cut(old, fresh, ground);
  EXPECT_EQ(cut.error, 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool taken = cut.mask[static_cast<std::size_t>(y * width + x)] != 0;
      if (x < 2) {
        EXPECT_FALSE(taken);
      }
      if (x <= step_at(y) - 1) {
        EXPECT_FALSE(taken) << x << ' ' << y;
      }
      if (x > step_at(y) + 1) {
        EXPECT_TRUE(taken) << x << ' ' << y;
      }
    }
}

TEST(SeamGraph, WhatCannotBeCutCounts) {
  // Bare beside firm: the seam lies between them, whatever it costs.
  const Image old(4, 3, 1, 0.0f), fresh(4, 3, 1, 0.5f);
  std::vector<Ground> ground(6 * 5, Ground::bare);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 2; ++x)
      ground[static_cast<std::size_t>((y + 1) * 6 + x + 1)] = Ground::firm;
  const PatchCut cut = graph_cut(old, fresh, ground);
  EXPECT_DOUBLE_EQ(cut.error, 3 * 2 * 0.25);
  EXPECT_EQ(cut.mask, (std::vector<unsigned char>{0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1}));
}

}  // namespace
}  // namespace gramloom
