#pragma once

#include <vector>

#include "neural/guidance.h"
#include "neural/guide_draws.h"
#include "neural/loss/patch_list.h"

namespace gramloom::neural {

/// The patches of an exemplar of that size that lie in usable pixels alone, row by row: of each
/// exemplar that is mixed, or of all together. Throws Error where there is none.
std::vector<std::vector<PatchPlace>> usable_places(const Guidance& guidance, Size exemplar,
                                                   int side);

/// The patches of a result of that size that count: those that have a pixel that is made. In the
/// order of their rows.
std::vector<PatchPlace> made_places(const Guidance& guidance, Size result, int side);

/// Which patches of one size are compared, and with which.
struct DirectedPlaces {
  int side = 0;
  std::vector<PatchPlace> counted;               // of the result
  std::vector<std::vector<PatchPlace>> usable;   // see usable_places()
  std::vector<GuideDraws> draws;                 // with a guide: of each of those
  GuideRows tags;                                // with a guide: w g of each counted patch
  GuideRows shares;                              // of exemplars that are mixed: likewise
  std::vector<std::vector<PatchPlace>> nearest;  // of a fill: see nearest_places()
};

/// With a guide, a patch that is unlike all of the exemplar's (a border between labels that the
/// exemplar never shows) doesn't count, where others hold all of its pixels.
DirectedPlaces directed_places(const Guidance& guidance, Size exemplar, Size result, int side);

/// Of a fill: what the patches that count are most like on the exemplar, by picture and guide:
/// (exemplars, places of `side`, 2), x and y. What a hole is to be like is so what its surroundings
/// and its layout are, not all of the exemplar; and what is continued already stays.
at::Tensor nearest_places(const Guidance& guidance, const at::Tensor& exemplar,
                          const at::Tensor& picture, int side, Random random);

/// Brings those, which are of patches of `side`, to patches as large or smaller: these become
/// `nearest`; a patch that lies in no larger one that counts doesn't count itself.
void take_nearest(const at::Tensor& nearest, const Guidance& guidance, Size result, int side,
                  DirectedPlaces& places);

}  // namespace gramloom::neural
