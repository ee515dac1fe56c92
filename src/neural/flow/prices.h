#pragma once

#include "neural/flow/patch_axes.h"

namespace gramloom::neural {

/// A price for each patch of the exemplar, row by row, added to its squared distance.
struct Prices {
  Size places;
  float* values;
};

struct PriceSteps {
  double rate;       // of the price for a use e times too high, relative to the mean distance
  double smoothing;  // patches that lie this near are one: deviation in pixels
  int repetitions;
  std::int64_t dimensions = 0;  // of vectors that a guide has made longer: those of the picture
};

/// Raises the price of references that queries use more often than others, lowers the others', so
/// that all are used alike: dual ascent of semi-discrete optimal transport. Of many queries some
/// are drawn. Offsets and scale are those of nearest_references(), without prices.
void update_prices(Prices prices, const std::vector<PatchPlace>& places, const Vectors& queries,
                   const Vectors& references, const std::vector<float>& offsets, float scale,
                   const PriceSteps& steps, Random random);

}  // namespace gramloom::neural
