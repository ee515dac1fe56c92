#pragma once

#include <vector>

#include "classic/patch_hole.h"
#include "core/random.h"

namespace gramloom {

/// Pixels about a patch that growth compares besides those of the patch.
inline constexpr int growth_context = 8;

/// Places of a level that growth may copy from.
struct GrowthPlaces {
  const PatchSource* source = nullptr;
  std::vector<PatchOrigin> origins = {};   // usable ones, evenly spread over all
  std::vector<unsigned char> inside = {};  // whether all pixels about each may be used, too
  Image features = {};  // the source's with growth_context more pixels on each side
  std::vector<unsigned char> valid = {};  // which of those pixels may be used

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(features.width) +
           static_cast<std::size_t>(x);
  }
};

/// Up to `most` of the usable origins.
GrowthPlaces growth_places(const PatchSource& source, std::size_t most);

/// Makes a hole without known pixels as a quilt (quilting.h), which keeps rows and grids straight:
/// sets its canvas and the origins of its patches. false: the source is too small for its patches.
bool quilt(PatchHole& hole, std::size_t level, const PatchSource& source, Random random);

/// Makes the pixels of a hole by growing from its border inward, as Criminisi, Pérez, Toyama 2004
/// ("Region filling and object removal by exemplar-based image inpainting"): the patch whose known
/// pixels are most and differ most comes next, and the rest of it is copied from where those are
/// alike. Departures: pixels about the patch are compared too, though they count less, as on the
/// coarsest level they show the structures that a patch is too small for; their data term, the
/// isophote across the border, is the deviation of the patch's known pixels; of places within
/// `tolerance` of the best one is drawn. Sets the canvas and the origins of patches: where the
/// patch's middle was copied from. Without known pixels it grows from a patch in the middle.
void grow(PatchHole& hole, const GrowthPlaces& places, float tolerance, Random random);

}  // namespace gramloom
