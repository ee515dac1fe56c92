#pragma once

#include <vector>

#include "core/image.h"
#include "signal/patch_source.h"

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

/// A pixel of 4 features.
typedef float FeaturePixel
    __attribute__((vector_size(field_features * sizeof(float)), aligned(4), may_alias));

/// A known pixel that a place is to have: how much it counts, and where it lies from its origin.
struct KnownPixel {
  FeaturePixel value;
  float weight;
  std::ptrdiff_t offset;  // in pixels of the places' features
};

/// What a patch looks for: like pixels where it has them, a like guide everywhere.
struct WantedPatch {
  std::vector<KnownPixel> pixels;  // the patch's own first
  float weight = 0;                // of all
  const PatchGuide* guide = nullptr;
  int x = 0, y = 0;
  float guide_weight = 0;
};

/// How much pixels about a patch count beside its own.
inline constexpr float context_weight = 0.2f;

/// The costs of places [first, last), as squared distances of whole patches; of those above `limit`
/// times the least so far only a part. A known pixel where a place has none counts a little.
void compare(const WantedPatch& wanted, const GrowthPlaces& places, std::size_t first,
             std::size_t last, float limit, float* costs);

}  // namespace gramloom
