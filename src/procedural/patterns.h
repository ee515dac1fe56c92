#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// Two colours in turn; of a solid, cubes of them.
struct Checkerboard {
  static constexpr std::string_view name = "checkerboard";
  static constexpr std::string_view summary = "squares of two colours in turn, cut from cubes";
  std::vector<double> first{0.93, 0.91, 0.86};
  std::vector<double> second{0.13, 0.12, 0.12};
  static constexpr auto fields() {
    return std::tuple{
        Field{"first", &Checkerboard::first, "one colour", "r, g, b", {0, 1}},
        Field{"second", &Checkerboard::second, "the other colour", "r, g, b", {0, 1}}};
  }
};

}  // namespace gramloom
