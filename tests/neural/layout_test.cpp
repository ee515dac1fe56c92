#include "neural/layout.h"

#include <gtest/gtest.h>

#include "neural/resample.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

at::Tensor blobs(Size size, std::uint64_t seed) {
  return resample(numbers({3, size.height / 4, size.width / 4}, seed), size, Tile::none);
}

// Straight from the definition: every shift, sums over what lies over each other.
double brute_force(const at::Tensor& a, const at::Tensor& b, std::int64_t beyond) {
  const at::Tensor x = a - a.mean({1, 2}, true), y = b - b.mean({1, 2}, true);
  double best = 0;
  for (std::int64_t dy = 1 - y.size(1); dy < x.size(1); ++dy)
    for (std::int64_t dx = 1 - y.size(2); dx < x.size(2); ++dx) {
      const std::int64_t top = std::max<std::int64_t>(0, dy), left = std::max<std::int64_t>(0, dx);
      const std::int64_t height = std::min(x.size(1), y.size(1) + dy) - top;
      const std::int64_t width = std::min(x.size(2), y.size(2) + dx) - left;
      if (4 * height * width < std::min(x[0].numel(), y[0].numel())) continue;
      if (std::max(std::abs(dy), std::abs(dx)) <= beyond) continue;
      const at::Tensor p = x.narrow(1, top, height).narrow(2, left, width);
      const at::Tensor q = y.narrow(1, top - dy, height).narrow(2, left - dx, width);
      const double energy = (p * p).sum().item<double>() * (q * q).sum().item<double>();
      best = std::max(best, (p * q).sum().item<double>() / std::sqrt(energy));
    }
  return best;
}

TEST(StrongestCorrelation, IsThatOfTheDefinition) {
  const at::Tensor a = blobs({24, 16}, 1), b = blobs({12, 20}, 2);
  for (const std::int64_t beyond : {-1, 0, 3})
    EXPECT_NEAR(strongest_correlation(a, b, beyond), brute_force(a, b, beyond), 1e-5);
  EXPECT_NEAR(strongest_correlation(a, a), 1, 1e-6);
}

TEST(LayoutCopied, TellsCopiesFromOthers) {
  const at::Tensor exemplar = blobs({32, 32}, 1);
  EXPECT_LT(layout_copied(blobs({32, 32}, 2), exemplar, Tile::both), 0.15);
  EXPECT_GT(layout_copied(exemplar, exemplar, Tile::none), 0.4);
  // Also when it goes on across the edges of a larger picture.
  at::Tensor larger = blobs({48, 48}, 3);
  larger.narrow(1, 0, 32).narrow(2, 0, 32).copy_(exemplar);
  const at::Tensor moved = at::roll(larger, {-16, -20}, {1, 2});
  EXPECT_GT(layout_copied(moved, exemplar, Tile::both), 0.4);
}

TEST(LayoutCopied, WhatIsRegularIsNoCopy) {
  at::Tensor grid = at::zeros({1, 32, 32});
  for (std::int64_t i = 0; i < 32; i += 8) {
    grid.narrow(1, i, 2).fill_(1);
    grid.narrow(2, i, 2).fill_(1);
  }
  EXPECT_LT(layout_copied(grid, grid, Tile::both), 0.05);
}

TEST(LayoutCopied, NothingOfFlatPictures) {
  const at::Tensor flat = at::full({3, 20, 20}, 0.5f);
  EXPECT_EQ(layout_copied(flat, flat, Tile::both), 0);
}

}  // namespace
}  // namespace gramloom::neural
