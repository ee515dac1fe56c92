#pragma once

#include <string_view>
#include <tuple>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"

namespace gramloom {

/// The zero-order model of a texture: each pixel is drawn on its own from the exemplar's joint
/// colour distribution, that is, it is a pixel of the exemplar chosen at random. Colours are right
/// and structure is gone: what every other method has to improve on. Any result tiles.
/// Of several exemplars all usable pixels are equally likely; with weights, the exemplar is drawn
/// by its weight at the pixel first. Known pixels stay; what is made knows nothing of them.
struct HistogramParams {
  static constexpr std::string_view kind = "histogram";
  static constexpr std::string_view summary =
      "independent pixels drawn from the exemplar's colours (no structure)";
  static constexpr Abilities abilities{Ability::exemplar, Ability::exemplars, Ability::mask,
                                       Ability::mix,      Ability::fill,      Ability::source};
  static constexpr auto fields() { return std::tuple{}; }
};

/// Throws Error for input that check_request() refuses.
Texture synthesise(const HistogramParams& params, const Request& request, const Control& control);
Cost estimate(const HistogramParams& params, const RequestSize& request);

}  // namespace gramloom
