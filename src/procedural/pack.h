#pragma once

#include <cstdint>
#include <cstring>

#include "core/simd.h"

namespace gramloom {

// Eight samples at a time, written as if they were one: the compiler's vector type, which has
// + − × ÷ and comparisons for every machine. All functions are built from operations that are
// rounded exactly, so that every machine computes the same bytes.

inline constexpr int pack_size = 8;
using Floats = float __attribute__((vector_size(4 * pack_size)));
using Ints = std::int32_t __attribute__((vector_size(4 * pack_size)));  // also masks: 0 or −1
using Uints = std::uint32_t __attribute__((vector_size(4 * pack_size)));

GRAMLOOM_INLINE Floats splat(float value) { return value - Floats{}; }
GRAMLOOM_INLINE Floats to_floats(Ints v) { return __builtin_convertvector(v, Floats); }
GRAMLOOM_INLINE Ints to_ints(Floats v) { return __builtin_convertvector(v, Ints); }
GRAMLOOM_INLINE Floats lane_numbers() { return Floats{0, 1, 2, 3, 4, 5, 6, 7}; }

GRAMLOOM_INLINE Floats select(Ints mask, Floats yes, Floats no) { return mask ? yes : no; }
GRAMLOOM_INLINE Uints select(Ints mask, Uints yes, Uints no) { return mask ? yes : no; }
GRAMLOOM_INLINE Floats min(Floats a, Floats b) { return a < b ? a : b; }
GRAMLOOM_INLINE Floats max(Floats a, Floats b) { return a > b ? a : b; }
GRAMLOOM_INLINE Floats min(Floats a, float b) { return min(a, splat(b)); }
GRAMLOOM_INLINE Floats max(Floats a, float b) { return max(a, splat(b)); }
GRAMLOOM_INLINE Floats abs(Floats v) { return Floats(Uints(v) & 0x7FFFFFFFu); }
GRAMLOOM_INLINE Floats clamp(Floats v, float low = 0, float high = 1) {
  return min(max(v, low), high);
}
GRAMLOOM_INLINE Floats mix(Floats a, Floats b, Floats t) { return a + (b - a) * t; }
GRAMLOOM_INLINE Floats square(Floats v) { return v * v; }

/// Rounded down, for |v| < 2³¹.
GRAMLOOM_INLINE Floats floor(Floats v) {
  const Floats truncated = to_floats(to_ints(v));
  return truncated + to_floats(Ints(truncated > v));
}
GRAMLOOM_INLINE Floats fraction(Floats v) { return v - floor(v); }

GRAMLOOM_INLINE Floats sqrt(Floats v) {
  Floats root;
  for (int lane = 0; lane < pack_size; ++lane) root[lane] = __builtin_sqrtf(v[lane]);
  return root;
}

/// 3t² − 2t³ of t = (v − from)/(to − from) clamped to [0, 1]; from > to falls instead of rising.
GRAMLOOM_INLINE Floats smoothstep(float from, float to, Floats v) {
  const Floats t = clamp((v - from) / (to - from));
  return t * t * (3 - 2 * t);
}
/// The linear ramp from 0 at `from` to 1 at `to`, clamped.
GRAMLOOM_INLINE Floats linstep(float from, float to, Floats v) {
  return clamp((v - from) / (to - from));
}

/// sin(2π·turns), to 4e-7.
GRAMLOOM_INLINE Floats sin_turns(Floats turns) {
  const Floats r = turns - floor(turns + 0.5f);  // [−½, ½]
  const Floats folded = 0.25f - abs(0.25f - abs(r));
  const Floats x = 6.2831853f * select(r < 0, -folded, folded);  // [−π/2, π/2], the same sine
  const Floats x2 = x * x;
  const Floats odd =
      1 + x2 * (-1.6666667e-1f +
                x2 * (8.3333333e-3f + x2 * (-1.9841270e-4f + x2 * (2.7557319e-6f - x2 * 2.5e-8f))));
  return x * odd;
}
GRAMLOOM_INLINE Floats cos_turns(Floats turns) { return sin_turns(turns + 0.25f); }
/// sin of radians.
GRAMLOOM_INLINE Floats sin(Floats v) { return sin_turns(v * 0.15915494f); }

/// 2ᵛ, to 2e-7 relative, for −126 ≤ v ≤ 127 (clamped).
GRAMLOOM_INLINE Floats exp2(Floats v) {
  const Floats x = clamp(v, -126, 127);
  const Floats whole = floor(x);
  const Floats f = (x - whole) * 0.69314718f;  // eᶠ with f in [0, ln 2)
  const Floats series =
      1 + f * (1 + f * (0.5f + f * (1.6666667e-1f +
                                    f * (4.1666668e-2f + f * (8.3333333e-3f + f * 1.3888889e-3f +
                                                              f * f * 1.9841270e-4f)))));
  const Floats power = Floats(Uints(to_ints(whole) + 127) << 23);
  return series * power;
}
GRAMLOOM_INLINE Floats exp(Floats v) { return exp2(v * 1.44269504f); }

/// log₂ v for normal v > 0.
GRAMLOOM_INLINE Floats log2(Floats v) {
  const Uints bits = Uints(v);
  const Uints shifted = bits - 0x3F3504F3u;  // mantissas to [√½, √2)
  const Floats exponent = to_floats(Ints(shifted) >> 23);
  const Floats m = Floats((shifted & 0x007FFFFFu) + 0x3F3504F3u);
  const Floats t = (m - 1) / (m + 1);
  const Floats t2 = t * t;
  return exponent + t * (2.8853901f + t2 * (0.96179669f + t2 * (0.57707802f + t2 * 0.41219859f)));
}
/// vᵖ for v ≥ 0 (below the smallest normal number: 0).
GRAMLOOM_INLINE Floats pow(Floats v, float p) {
  return select(v > 1.2e-38f, exp2(p * log2(max(v, 1.2e-38f))), Floats{});
}

GRAMLOOM_INLINE void store(Floats v, float* to, int count = pack_size) {
  std::memcpy(to, &v, sizeof(float) * static_cast<std::size_t>(count));
}

/// Mixes all bits (Wellons 2018, "lowbias32").
GRAMLOOM_INLINE Uints hash(Uints v) {
  v = (v ^ (v >> 16)) * 0x7FEB352Du;
  v = (v ^ (v >> 15)) * 0x846CA68Bu;
  return v ^ (v >> 16);
}
/// [0, 1) from a hash; further independent numbers from further `which`.
GRAMLOOM_INLINE Floats unit_float(Uints h) { return to_floats(Ints(h >> 8)) * 0x1p-24f; }
GRAMLOOM_INLINE Floats unit_float(Uints h, std::uint32_t which) {
  return unit_float(hash(h + which * 0x9E3779B9u));
}

/// A point in D dimensions, eight of them.
template <int D>
struct Point {
  Floats at[D];
};

}  // namespace gramloom
