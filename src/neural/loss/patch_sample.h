#pragma once

#include <ATen/ATen.h>

#include <vector>

#include "core/random.h"
#include "neural/loss/patch_lines.h"

namespace gramloom::neural {

/// Positions (x, y) to (x + length − 1, y); the sample has them from `place` on.
struct PatchRun {
  std::int64_t x, y, length, place;
};

/// A random part of the positions of a picture, in short runs: of every few rows and 64 columns one
/// row, each as likely as the others, so that every position is there with one probability, and
/// every region of the picture, whatever its period.
struct PatchSample {
  std::vector<PatchRun> runs;
  std::int64_t count = 0;  // positions

  /// About `most` of the positions, or all where they are fewer. The same `random` draws the same
  /// ones of pictures of one size.
  PatchSample(const PatchPositions& positions, std::int64_t most, Random random);
  /// Those of it that lie in these rows, which are counted from the first of them.
  PatchSample in_rows(std::int64_t begin, std::int64_t end) const;

 private:
  PatchSample() = default;
};

/// The patches of a sample of a picture's positions as numbers: their product with each of the
/// filters (filters, channels, k, k). The result is (filters, sample.count).
at::Tensor project_sample(const at::Tensor& picture, const at::Tensor& filters, Tile wraps,
                          const PatchSample& sample);

}  // namespace gramloom::neural
