#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"

namespace gramloom {

/// One axis of the levels of a generated picture. Where the picture tiles, a level is
/// `length` pixels long, half of the next finer one, rounded, and positions wrap; else it is
/// endless, and each level exactly half of the next.
struct LevelAxis {
  std::int64_t length = 0;   // 0: endless
  std::int64_t coarser = 0;  // length of the next coarser level

  /// The position whose noise a pixel has.
  std::uint32_t noise_at(std::int64_t x) const {
    return static_cast<std::uint32_t>(length == 0 ? x : ((x % length) + length) % length);
  }
};

/// The axes of all levels, the coarsest first.
std::vector<LevelAxis> level_axes(int length, bool tiles, int levels);

/// Pixels [first, first + weights.size()) of a level lie between pixels `from[i]` and
/// `from[i] + 1` of the next coarser one, by `weights[i]` nearer to the latter.
struct Upsampling {
  std::vector<std::int64_t> from;
  std::vector<float> weights;
};
Upsampling upsampling(const LevelAxis& axis, std::int64_t first, int count);

/// How many pixels of the coarser level any `count` pixels lie between, at most.
int coarser_count(const LevelAxis& axis, int count);

}  // namespace gramloom
