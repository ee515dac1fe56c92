#pragma once

#include <vector>

#include "neural/flow/patch_axes.h"
#include "neural/guidance.h"

namespace gramloom::neural {

/// Gives the vectors of patches further coordinates, so that nearest_references() finds those that
/// are near in picture and guide: to |q − t r|² they add w² |g − h|², g and h the guides of the
/// result's and of the exemplar's patch, quarter by quarter (quarter_means.h), in the unit in which
/// a picture has total variance 1; but for w² |g|², which is the same for all of them. Without a
/// guide vectors stay as they are.
class GuidedPatches {
 public:
  /// mean_square: of the values that the patches' vectors are made of.
  GuidedPatches(const Guidance& guidance, int side, double mean_square);

  Vectors queries(Vectors of_picture, const std::vector<PatchPlace>& places) const;
  Vectors references(Vectors of_exemplar, const std::vector<PatchPlace>& places, float t) const;

 private:
  Image means_, exemplar_means_, weight_;  // weight_: w² of the patch in the vectors' unit
};

/// The squared lengths of vectors.
std::vector<float> squares_of(const Vectors& vectors);

/// Of the usable values.
double mean_square_of(const Image& image, const Image& usable);

/// About `most` of the places, all where they are no more, in their order.
std::vector<PatchPlace> some_of(const std::vector<PatchPlace>& places, std::size_t most,
                                Random random);

}  // namespace gramloom::neural
