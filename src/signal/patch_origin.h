#pragma once

#include <cstdint>

#include "core/image.h"

namespace gramloom {

/// Patches that are compared as wholes: 8×8 pixels of 4 features (see patch_features.h).
inline constexpr int field_patch = 8;
inline constexpr int field_features = 4;
inline constexpr float patch_area = field_patch * field_patch;

/// Number of patches of an image in each direction.
Size patch_origins(Size image);

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
