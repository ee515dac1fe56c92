#pragma once

#include <cstdint>

namespace gramloom::neural {

/// Where share `i` of `count` rows begins that are shared out among `shares`; it ends where the
/// next one begins.
constexpr std::int64_t begin_of_share(std::int64_t count, std::int64_t i, std::int64_t shares) {
  return count * i / shares;
}

}  // namespace gramloom::neural
