#pragma once

#include <ATen/ATen.h>

#include <functional>

#include "core/random.h"
#include "neural/flow/prices.h"

namespace gramloom::neural {

/// Pixels between patches that vote, on both axes.
inline constexpr int patch_stride = 2;

/// Where the patches of a step came from: (rows, columns, 2), x and y of each one's nearest place
/// in the exemplar less its own place in the picture, which is `size` large.
at::Tensor sources_of(Size size, const std::vector<PatchPlace>& queries,
                      const std::vector<PatchPlace>& references, const Neighbours& nearest);

struct Sources {
  const at::Tensor& shifts;  // of the last step
  Size size;                 // of the present picture
  bool of_coarser;           // the last step was on the octave of half that size
};
struct Search {
  const std::vector<PatchPlace>& queries;
  const Vectors& of_picture;
  float scale;  // of nearest_references()
  Prices prices;
  std::int64_t dimensions;  // of the vectors, without those of a guide (guided_patches.h)
  std::function<Vectors(const std::vector<PatchPlace>&)> references;  // vectors of the exemplar's
  std::function<bool(PatchPlace)> usable;                             // place of the exemplar
};

/// Offers a share of the patches what their own place and one beside it came from in the last step,
/// moved along with them: pieces of the exemplar then grow beyond a patch, as in PatchMatch. What
/// is nearer than the neighbours found takes its place among them; its place joins the references.
void remember(const Sources& sources, const Search& search, double share, Random random,
              std::vector<PatchPlace>& references, Neighbours& found);

}  // namespace gramloom::neural
