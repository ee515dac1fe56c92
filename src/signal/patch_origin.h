#pragma once

#include <cstdint>

namespace gramloom {

/// The first pixel of a patch in the exemplar.
struct PatchOrigin {
  int x = 0;
  int y = 0;

  friend bool operator==(const PatchOrigin&, const PatchOrigin&) = default;
};

/// The same in half the memory, for where there are millions: 0 to 65,535.
struct SmallOrigin {
  static constexpr int most = 65'535;

  std::uint16_t x = 0;
  std::uint16_t y = 0;

  SmallOrigin() = default;
  SmallOrigin(int x_, int y_)
      : x(static_cast<std::uint16_t>(x_)), y(static_cast<std::uint16_t>(y_)) {}
  SmallOrigin(PatchOrigin origin) : SmallOrigin(origin.x, origin.y) {}
  operator PatchOrigin() const { return {x, y}; }
};

}  // namespace gramloom
