#pragma once

#include <string_view>
#include <tuple>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"

namespace gramloom {

/// Heeger & Bergen 1995, "Pyramid-based texture analysis/synthesis": noise whose pixels and whose
/// bands of a steerable pyramid are given the exemplar's histograms in turn. Colours are first
/// decorrelated by PCA (section 3.5) and each axis is synthesised on its own. Rough, granular and
/// marbled surfaces come out right; shapes and long lines don't.
///
/// As Briand, Vacher, Galerne, Rabin 2014, "The Heeger & Bergen pyramid-based texture synthesis
/// algorithm" (IPOL), advise: bands are taken of the exemplar's periodic component (Moisan 2011),
/// so that its edges add nothing, and histograms are matched by rank, not over bins.
/// Departures: sizes need not be related (matching interpolates quantiles; the pyramid takes any
/// size); and after the return from the PCA axes each colour channel is given the exemplar's
/// histogram once more, so that it ends exactly right and in range. Maps are not mixed with
/// colours: the PCA is each layer's own, and what colours tell of a map, linearly, it has of the
/// colours that were made (signal/layer_axes.h): the colours are the same with maps and without.
///
/// Several exemplars, masks and mixing by weights that are everywhere the same: see
/// classic/pyramid_statistics.h. Weights that change from place to place blend textures of each
/// exemplar that were made of the same noise: classic/pyramid_blend.h.
struct PyramidParams {
  static constexpr std::string_view kind = "pyramid";
  static constexpr std::string_view summary =
      "noise with the histograms of the exemplar's steerable pyramid (rough surfaces)";
  static constexpr Abilities abilities{Ability::exemplar, Ability::exemplars, Ability::mask,
                                       Ability::mix};
  int levels = 5;
  int orientations = 4;
  int iterations = 5;
  static constexpr auto fields() {
    return std::tuple{
        Field{"levels",
              &PyramidParams::levels,
              "octaves of the pyramid; fewer where the exemplar or the result is small",
              "",
              {1, 12}},
        Field{
            "orientations", &PyramidParams::orientations, "directions of each octave", "", {1, 16}},
        Field{"iterations",
              &PyramidParams::iterations,
              "rounds of histogram matching",
              "",
              {1, 100}}};
  }
};

/// Throws Error for input that check_request() refuses.
Texture synthesise(const PyramidParams& params, const Request& request, const Control& control);
Cost estimate(const PyramidParams& params, const RequestSize& request);

}  // namespace gramloom
