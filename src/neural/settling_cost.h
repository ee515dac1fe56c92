#pragma once

namespace gramloom::neural {

// How much settle_maps() (settled_maps.h) looks at; apart, for whoever estimates without LibTorch.

/// Places of the exemplar that a picture's places are compared with, and numbers that each is
/// compared by.
inline constexpr int settling_references = 4096;
inline constexpr int settling_axes = 12;

/// Operations for a picture of so many pixels.
inline double settling_operations(double pixels) {
  return 2.0 * pixels * settling_references * (settling_axes + 1);
}

}  // namespace gramloom::neural
