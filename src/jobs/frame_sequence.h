#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// Poses that go evenly from a first to a last one, each of which an inference makes a picture of.
struct FrameSequence {
  std::vector<double> pose;  // none: no sequence
  std::vector<double> to;
  int frames = 24;
  bool extrapolate = false;

  static constexpr auto fields() {
    using F = FrameSequence;
    return std::tuple{
        Field{"pose", &F::pose,
              "first pose of a sequence that the trained model makes, in the order of the table's "
              "columns; none: no sequence"},
        Field{"to", &F::to, "last pose of the sequence"},
        Field{"frames", &F::frames, "pictures of the sequence", "", {1, 9999}},
        Field{"extrapolate", &F::extrapolate,
              "poses of the sequence outside the ranges that are learnt too"}};
  }
};

/// The poses, the first and the last exactly as they were given; of one frame, the first.
std::vector<std::vector<double>> poses_of(const FrameSequence& sequence);

}  // namespace gramloom
