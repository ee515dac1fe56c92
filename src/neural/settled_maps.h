#pragma once

#include <cstdint>

#include "core/request.h"
#include "neural/group.h"
#include "neural/map_references.h"

namespace gramloom::neural {

// Maps of a synthesised picture as they go with its colours in the exemplar.
//
// An optimiser leaves a grain of its own in each layer: a height that the colours tell is off by a
// fifth to a half of its deviation, and lit it looks like sand. So at the end each place of 3×3
// pixels looks for the like place of the exemplar, by its colours and, for less, by its maps, and
// each pixel's maps become the mean of what the nine places over it found there: the vote of
// patches (Wexler, Shechtman, Irani 2007; Kwatra et al. 2005, "Texture optimization"), of maps
// alone. Colours stay. What votes have other colours than the pixel, the maps follow by the slope
// that they have against the colours in the exemplar. A mean has less grain than what it is of: as
// much of the place in whose middle the pixel lies is added as makes steps from pixel to pixel as
// large as the exemplar's.
//
// A layer that is not told so, a grain that has nothing to do with the colours, would only lose its
// contrast: it stays as it is. Whether it is told, by colours alone, is tried on the exemplar
// itself.

/// The layers of the exemplar after the first that its colours tell; no coverage.
std::vector<Layer> told_layers(const Exemplar& exemplar, Random random);

/// Changes the own rows of the picture, of the exemplar's layers, in these of its layers. `around`:
/// a copy of those rows and of settled_margin more above and below, around the circle; the own rows
/// as they are, where they are all that there is.
void settle_maps(const Exemplar& exemplar, const std::vector<Layer>& layers, Tile tile,
                 Random random, const ImageRows& around, Rows own_rows, const Group& group,
                 Image& own);
inline constexpr std::int64_t settled_margin = 3;

}  // namespace gramloom::neural
