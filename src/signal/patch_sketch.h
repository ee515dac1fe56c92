#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/simd.h"
#include "signal/patch_origin.h"

namespace gramloom {

/// A patch at a glance, by which most bad matches are told from good ones without a look at their
/// pixels: the sums of its features over each of its quarters, as small whole numbers.
struct alignas(16) PatchSketch {
  std::array<std::int8_t, 4 * field_features> values;
};

/// What a whole number stands for: (sum − middle) / 4 / step, rounded, and cut at ±127. Sums of a
/// quarter over 4, the root of its pixels, differ by no more than the quarters themselves do: the
/// square of a mean is at most the mean of squares.
struct SketchScale {
  std::array<float, field_features> middle;
  float step;
};

/// A scale for the features of an exemplar and of what is made of them.
SketchScale sketch_scale(const Image& features);

/// The sketches of all patches, row by row.
std::vector<PatchSketch> sketch_patches(const Image& features, const SketchScale& scale);
/// Those of rows [first, last).
std::vector<PatchSketch> sketch_patches(const Image& features, const SketchScale& scale, int first,
                                        int last);

typedef int Four __attribute__((vector_size(16)));

namespace detail {
/// Four parts of the squared difference of two sketches.
GRAMLOOM_INLINE Four squared_parts(const PatchSketch& a, const PatchSketch& b) {
  typedef std::int8_t Bytes __attribute__((vector_size(16)));
  typedef std::uint16_t Words __attribute__((vector_size(32)));
  typedef std::uint32_t Longs __attribute__((vector_size(32)));
  const Words d = __builtin_convertvector(*reinterpret_cast<const Bytes*>(a.values.data()), Words) -
                  __builtin_convertvector(*reinterpret_cast<const Bytes*>(b.values.data()), Words);
  const Longs squares = reinterpret_cast<Longs>(d * d);  // two in each, at most 254²
  const Longs sums = (squares & 0xFFFF) + (squares >> 16);
  return reinterpret_cast<Four>(__builtin_shufflevector(sums, sums, 0, 1, 2, 3)) +
         reinterpret_cast<Four>(__builtin_shufflevector(sums, sums, 4, 5, 6, 7));
}
}  // namespace detail

/// Squared differences of a sketch from four others.
GRAMLOOM_INLINE Four differences(const PatchSketch& from, const PatchSketch& a,
                                 const PatchSketch& b, const PatchSketch& c, const PatchSketch& d) {
  const auto add_pairs = [](Four v, Four w) __attribute__((always_inline)) {
    return __builtin_shufflevector(v, w, 0, 2, 4, 6) + __builtin_shufflevector(v, w, 1, 3, 5, 7);
  };
  return add_pairs(add_pairs(detail::squared_parts(from, a), detail::squared_parts(from, b)),
                   add_pairs(detail::squared_parts(from, c), detail::squared_parts(from, d)));
}

/// Patches whose sketches differ by this much or more are at least a squared distance apart.
int telling_difference(float squared_distance, const SketchScale& scale);

}  // namespace gramloom
