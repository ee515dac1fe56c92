#pragma once

#include <ATen/ATen.h>

#include <vector>

#include "core/image.h"
#include "core/random.h"

namespace gramloom::neural {

/// Throws Error when the exemplar, or the result on an axis that does not wrap, is smaller than one
/// of the patches.
void check_patches_fit(const std::vector<int>& patch_sizes, Size exemplar, Size target, Tile wraps);

/// The sliced Wasserstein distance between the patches of two pictures (Heitz, Vanhoey, Chambon,
/// Belcour 2021, equation 6, with W₁ for W₂ and patches for a network's features; as Elnekave,
/// Weiss 2022, "Generating natural images with direct patch distributions matching"): along each
/// of many random directions in the space of patches, both sets of values are sorted, and the
/// distance is that between values of one rank. Divided by the exemplar's distance from a flat
/// picture, so that it is 0 for the exemplar and about 1 for no structure at all.
class SlicedTerm {
 public:
  static constexpr std::string_view name = "sliced";

  /// patch_sizes: sides of the patches; step i has patch_sizes[i mod their number].
  /// wraps: the edges across which patches of the result go on; the exemplar's stay inside.
  /// Throws Error when the exemplar or the result, of size `target`, is smaller than a patch.
  SlicedTerm(at::Tensor exemplar, Size target, Tile wraps, std::vector<int> patch_sizes,
             int directions, Random random);

  /// The distance along the directions of that step; adds `weight` times its gradient.
  double add(const at::Tensor& picture, double weight, std::uint64_t step,
             at::Tensor& gradient) const;

 private:
  at::Tensor filters(std::uint64_t step) const;

  at::Tensor exemplar_;
  Tile wraps_;
  std::vector<int> patch_sizes_;
  int directions_;
  Random random_;
  double flat_ = 0;  // the exemplar's distance from a flat picture
};

/// Values that are projected at once: a larger picture is compared along fewer directions at a
/// time, so that memory grows with the picture alone. Not along too few: patches are gathered anew
/// each time, which costs as much as eight directions.
inline constexpr std::int64_t sliced_values_at_once = std::int64_t{1} << 23;
inline constexpr std::int64_t least_directions_at_once = 8;

}  // namespace gramloom::neural
