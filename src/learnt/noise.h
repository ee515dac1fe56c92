#pragma once

#include <array>
#include <cstdint>

namespace gramloom {

/// The noise that generators see: a function of place and seed alone, so that any part of a picture
/// of any size can be made by itself, by any program. PCG4D (Jarzynski and Olano 2020, "Hash
/// functions for GPU rendering", JCGT 9(3)) of (x, y, seed, 64 · level + channel / 4) gives four
/// channels at once.
inline std::array<std::uint32_t, 4> pcg4d(std::uint32_t x, std::uint32_t y, std::uint32_t z,
                                          std::uint32_t w) {
  const auto step = [](std::uint32_t v) { return v * 1664525u + 1013904223u; };
  x = step(x), y = step(y), z = step(z), w = step(w);
  x += y * w, y += z * x, z += x * y, w += y * z;
  x ^= x >> 16, y ^= y >> 16, z ^= z >> 16, w ^= w >> 16;
  x += y * w, y += z * x, z += x * y, w += y * z;
  return {x, y, z, w};
}

/// Of its upper 24 bits: uniform in [−√3, √3), of mean 0 and variance 1.
inline float noise_value(std::uint32_t bits) {
  constexpr float root = 1.7320508f;
  constexpr float step = 2 * root / 16777216.0f;
  return static_cast<float>(bits >> 8) * step - root;
}

/// Words of the hash's last argument for each level.
inline constexpr int noise_groups_per_level = 64;

}  // namespace gramloom
