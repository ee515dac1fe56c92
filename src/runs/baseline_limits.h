#pragma once

#include <string_view>
#include <tuple>

#include "core/fields.h"

namespace gramloom {

/// How far a run may be from its baseline: the [baseline] table of a config. Pictures are judged as
/// in OpenImageIO's test suite: few pixels may differ visibly, and none by much.
struct BaselineLimits {
  double pixel_tolerance = 0.01;
  double pixel_share = 0.01;
  double pixel_limit = 0.1;
  double score_change = 0.1;
  double score_floor = 0.02;

  static constexpr auto fields() {
    using L = BaselineLimits;
    return std::tuple{
        Field{"pixel_tolerance",
              &L::pixel_tolerance,
              "a pixel differs where a channel differs by more; black to white is 1",
              "",
              {0, 1e9}},
        Field{"pixel_share", &L::pixel_share, "share of the pixels that may differ", "", {0, 1}},
        Field{"pixel_limit",
              &L::pixel_limit,
              "no channel of any pixel may differ by more",
              "",
              {0, 1e9}},
        Field{"score_change",
              &L::score_change,
              "how much further from its best value a score may be, as a share of its distance",
              "",
              {0, 1e9}},
        Field{
            "score_floor", &L::score_floor, "distances below this count as this", "", {1e-9, 1e9}},
    };
  }
};

}  // namespace gramloom
