#pragma once

#include <string_view>
#include <tuple>

#include "core/fields.h"
#include "core/image.h"
#include "core/progress.h"
#include "core/random.h"

namespace gramloom {

/// The zero-order model of a texture: each pixel is drawn on its own from the exemplar's joint
/// colour distribution, that is, it is a pixel of the exemplar chosen at random. Colours are right
/// and structure is gone: what every other method has to improve on. Any result tiles.
struct HistogramParams {
  static constexpr std::string_view kind = "histogram";
  static constexpr std::string_view summary =
      "independent pixels drawn from the exemplar's colours (no structure)";
  static constexpr auto fields() { return std::tuple{}; }
};

/// Throws Error for input that check_input() refuses.
Texture synthesise(const HistogramParams&, const Image& exemplar, const Target&, Random,
                   const Control&);
Cost estimate(const HistogramParams&, Size exemplar, int channels, const Target&);

}  // namespace gramloom
