#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "core/image.h"
#include "core/random.h"

namespace gramloom {

/// Pictures with known faults, whose scores make the others readable.
enum class ControlKind {
  shuffled,      // the exemplar's pixels in random order: its colours, and nothing else
  random_phase,  // its spectrum with random phases (Galerne, Gousseau, Morel 2011): no shapes
  tiled,         // the exemplar over and over: likeness by copying
  halves         // its left (or upper) half against the other one: how alike two true pieces are
};
template <>
inline constexpr auto enum_names<ControlKind> =
    std::to_array<std::string_view>({"shuffled", "random_phase", "tiled", "halves"});

/// What to score against what: score(pair.exemplar, pair.image, Tile::none).
struct ControlPair {
  Image exemplar;
  Image image;
};

/// `size` is the image's, except for halves, which are as large as they are. A shuffled image
/// larger than the exemplar repeats its colours equally often, but for a rest. Throws Error for an
/// exemplar that is empty, or of one pixel for halves, and for a size below 1.
ControlPair control_pair(ControlKind kind, const Image& exemplar, Size size, Random random);

}  // namespace gramloom
