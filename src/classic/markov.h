#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"

namespace gramloom {

/// Which pixels a pixel's context is made of.
enum class MarkovNeighbourhood {
  row,    // the preceding pixels of its row
  causal  // the nearest of all preceding pixels: left, above, above left, above right, …
};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<MarkovNeighbourhood>{"row", "causal"};

/// A Markov chain of pixels in scan order, as Shannon 1948 ("A mathematical theory of
/// communication", section 3) made English of letters: each pixel is drawn given the `order` ones
/// before it, with the frequencies of the exemplar. A context never seen backs off to its nearest
/// part that was (as Katz 1987, without discounting).
///
/// Contexts compare colours quantised to a palette learnt from the exemplar. What is written is the
/// exemplar's pixel at the place that was drawn, so order 0 is the method `histogram`, and a
/// palette of few colours doesn't show in the result.
/// Departures: rows start afresh rather than where the previous one ended, since the two ends of
/// an image are not neighbours; a margin that is cut off lets the chain settle. Where the result
/// tiles, the pixels along the seam are then drawn again a few times given their neighbours on both
/// sides (Geman & Geman 1984).
///
/// Pixels that may not be used are unknown symbols, as those beyond an edge are; several exemplars
/// lie side by side with such a pixel between. Known pixels of the target are context like any
/// others, and pixels that are made within 8 of them are drawn again as along a seam.
struct MarkovParams {
  static constexpr std::string_view kind = "markov";
  static constexpr std::string_view summary =
      "pixels drawn given the preceding ones in scan order (streaks, or small structure)";
  static constexpr Abilities abilities{Ability::exemplar, Ability::exemplars, Ability::mask,
                                       Ability::fill, Ability::source};
  int order = 4;
  int colours = 16;
  MarkovNeighbourhood neighbourhood = MarkovNeighbourhood::row;
  static constexpr auto fields() {
    return std::tuple{
        Field{"order",
              &MarkovParams::order,
              "preceding pixels that a pixel depends on",
              "pixels",
              {0, 32}},
        Field{"colours", &MarkovParams::colours, "colours that contexts tell apart", "", {1, 255}},
        Field{"neighbourhood", &MarkovParams::neighbourhood,
              "preceding pixels of the row, or the nearest ones of it and the rows above"}};
  }
};

/// Throws Error for input that check_request() refuses.
Texture synthesise(const MarkovParams& params, const Request& request, const Control& control);
Cost estimate(const MarkovParams& params, const RequestSize& request);

}  // namespace gramloom
