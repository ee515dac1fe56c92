// What quilting is made of: overlap errors, cuts, and the grid of patches.
#include "classic/overlap.h"

#include <gtest/gtest.h>

#include "classic/patch_grid.h"
#include "classic/seam.h"
#include "patch_exemplars.h"

namespace gramloom {
namespace {

double direct_error(const Image& exemplar, const Image& patch, const Sides& sides, int u, int v) {
  double sum = 0;
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x)
      if (sides.covers(x, y, patch.size()))
        for (int c = 0; c < patch.channels; ++c)
          sum += std::pow(double{exemplar.at(u + x, v + y)[c]} - double{patch.at(x, y)[c]}, 2);
  return sum;
}

TEST(OverlapErrors, EqualDirectSums) {
  for (const int channels : {1, 3, 5})
    for (const Size size : {Size{37, 29}, Size{23, 64}, Size{50, 11}}) {
      const Image exemplar = blobs(size.width, size.height, channels, 1);
      const Image patch = blobs(9, 11, channels, 2);
      const OverlapErrors overlap(exemplar, patch.size());
      for (const Sides sides :
           {Sides{3, 0, 0, 0}, Sides{0, 4, 0, 0}, Sides{3, 4, 0, 0}, Sides{3, 4, 2, 0},
            Sides{0, 0, 5, 1}, Sides{3, 4, 2, 5}, Sides{5, 6, 4, 5}}) {
        std::vector<float> errors;
        overlap.compute(patch, sides, errors);
        ASSERT_EQ(overlap.positions(), (Size{size.width - 8, size.height - 10}));
        std::size_t i = 0;
        for (int v = 0; v < overlap.positions().height; ++v)
          for (int u = 0; u < overlap.positions().width; ++u, ++i)
            ASSERT_NEAR(errors[i], direct_error(exemplar, patch, sides, u, v), overlap.noise(sides))
                << u << ' ' << v;
      }
    }
}

/// The least sum over all paths, by trying all.
float least_path(const std::vector<float>& errors, int length, int width, int row, int column) {
  const float here = errors[static_cast<std::size_t>(row * width + column)];
  if (row + 1 == length) return here;
  float best = std::numeric_limits<float>::infinity();
  for (int next = std::max(0, column - 1); next <= std::min(width - 1, column + 1); ++next)
    best = std::min(best, least_path(errors, length, width, row + 1, next));
  return here + best;
}

TEST(MinimumCut, EqualsBruteForce) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const int length = 1 + static_cast<int>(random.below(8));
    const int width = 1 + static_cast<int>(random.below(5));
    std::vector<float> errors(static_cast<std::size_t>(length * width));
    for (float& e : errors) e = static_cast<float>(random.below(64));  // sums are exact
    float least = std::numeric_limits<float>::infinity();
    for (int column = 0; column < width; ++column)
      least = std::min(least, least_path(errors, length, width, 0, column));
    const std::vector<int> path = minimum_cut(errors, length, width);
    ASSERT_EQ(static_cast<int>(path.size()), length);
    float sum = 0;
    for (int row = 0; row < length; ++row) {
      ASSERT_GE(path[static_cast<std::size_t>(row)], 0);
      ASSERT_LT(path[static_cast<std::size_t>(row)], width);
      if (row > 0) {
        ASSERT_LE(
            std::abs(path[static_cast<std::size_t>(row)] - path[static_cast<std::size_t>(row - 1)]),
            1);
      }
      sum += errors[static_cast<std::size_t>(row * width + path[static_cast<std::size_t>(row)])];
    }
    ASSERT_EQ(sum, least);
  }
}

TEST(Cut, FollowsPixelsThatAgree) {
  // Old and fresh agree on the lines two pixels in from each side and nowhere else.
  const Size patch{12, 10};
  Image old(patch, 1, 0.0f), fresh(patch, 1, 1.0f);
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x)
      if (x == 2 || y == 2 || x == patch.width - 3 || y == patch.height - 3) *fresh.at(x, y) = 0;
  const PatchCut best = cut(old, fresh, {4, 4, 4, 4});
  EXPECT_EQ(best.error, 0);
  const auto& mask = best.mask;
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x)
      if (*fresh.at(x, y) > 0) {
        const bool inside = x > 2 && y > 2 && x < patch.width - 3 && y < patch.height - 3;
        EXPECT_EQ(int{mask[static_cast<std::size_t>(y * patch.width + x)]}, inside)
            << x << ' ' << y;
      }
}

TEST(Cut, TakesAllThatIsUnfilled) {
  const Image old = blobs(16, 16, 3, 4), fresh = blobs(16, 16, 3, 5);
  for (const Sides sides : {Sides{}, Sides{5, 0, 0, 0}, Sides{5, 5, 0, 0}, Sides{0, 5, 6, 3}}) {
    const auto mask = cut(old, fresh, sides).mask;
    const auto weights = feathered(mask, old.size(), sides, 2);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const auto i = static_cast<std::size_t>(y * 16 + x);
        EXPECT_GE(weights[i], 0);
        EXPECT_LE(weights[i], 1);
        if (!sides.covers(x, y, old.size())) {
          EXPECT_EQ(mask[i], 1);
          EXPECT_EQ(weights[i], 1);
        }
      }
  }
}

TEST(PatchGrid, CoversEveryLength) {
  for (const bool wraps : {false, true})
    for (int length = 1; length <= 130; ++length)
      for (const int patch : {1, 2, 3, 8, 32, 40})
        for (const int overlap : {0, 1, 2, 5, 16, 20}) {
          if (overlap > patch / 2) continue;
          const PatchAxis axis = cover(length, patch, overlap, wraps);
          ASSERT_GE(axis.count(), 1);
          ASSERT_GE(axis.patch, 1);
          ASSERT_LE(axis.patch, std::min(patch, length))
              << length << ' ' << patch << ' ' << overlap;
          ASSERT_EQ(axis.starts.front(), 0);
          if (!wraps) {
            ASSERT_EQ(axis.starts.back() + axis.patch, length);
          }
          for (int i = 0; i < axis.count(); ++i) {
            ASSERT_GE(axis.before(i), 0) << "a gap";
            ASSERT_LE(axis.before(i) + axis.after(i), axis.patch) << "overlaps meet";
          }
        }
}

TEST(PatchGrid, WavesLayEachPatchOnceAndNeverNeighbours) {
  for (const bool wrap_x : {false, true})
    for (const bool wrap_y : {false, true})
      for (const Size size : {Size{100, 100}, Size{30, 200}, Size{200, 30}, Size{9, 9}}) {
        const PatchAxis x = cover(size.width, 16, 4, wrap_x), y = cover(size.height, 16, 4, wrap_y);
        std::set<std::pair<int, int>> laid;
        const auto apart = [](int a, int b, const PatchAxis& axis) {
          const int d = std::abs(a - b);
          return axis.wraps ? std::min(d, axis.count() - d) : d;
        };
        for (const auto& wave : waves(x, y)) {
          for (const PatchSlot& a : wave)
            for (const PatchSlot& b : wave)
              if (&a != &b) {
                EXPECT_TRUE(apart(a.column, b.column, x) > 1 || apart(a.row, b.row, y) > 1);
              }
          for (const PatchSlot& slot : wave)
            EXPECT_TRUE(laid.insert({slot.column, slot.row}).second);
        }
        EXPECT_EQ(static_cast<int>(laid.size()), x.count() * y.count());
      }
}

TEST(PatchGrid, LastPatchMeetsTheFirstWhereItTiles) {
  const PatchAxis x = cover(100, 20, 4, true), y = cover(100, 20, 4, true);
  for (const auto& wave : waves(x, y))
    for (const PatchSlot& slot : wave) {
      EXPECT_EQ(slot.sides.right > 0, slot.column + 1 == x.count());
      EXPECT_EQ(slot.sides.bottom > 0, slot.row + 1 == y.count());
      EXPECT_EQ(slot.sides.left > 0, slot.column > 0);
      EXPECT_EQ(slot.sides.top > 0, slot.row > 0);
    }
}

}  // namespace
}  // namespace gramloom
