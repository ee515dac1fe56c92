#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "core/error.h"
#include "core/fields.h"
#include "core/threads.h"
#include "neural/loss/loss_cost.h"

namespace gramloom {

/// The sliced Wasserstein distance between the patches of two pictures (Heitz, Vanhoey, Chambon,
/// Belcour 2021, "A sliced Wasserstein loss for neural texture synthesis", equation 6, with W₁ for
/// W₂ and patches for a network's features; as Elnekave, Weiss 2022, "Generating natural images
/// with direct patch distributions matching"): along each of many random directions in the space
/// of patches, both sets of values are sorted, and the distance is that between values of one rank.
/// Directions are drawn anew in each step of Adam. Divided by the exemplar's distance from a flat
/// picture, so that it is 0 for the exemplar and about 1 for no structure at all. Of a flat
/// exemplar the colour is all there is to match.
/// Of a picture of more than `positions` patches the distance is that of a random part, drawn anew
/// in each step (patch_sample.h). From it follows where each patch of the whole should go
/// (potential.h), so that every pixel changes in every step.
struct SlicedParams {
  static constexpr std::string_view name = "sliced";
  double sliced_weight = 1;
  std::vector<int> patch_sizes{7, 5};
  int positions = 300'000;

  double weight() const { return sliced_weight; }
  static constexpr auto fields() {
    using P = SlicedParams;
    return std::tuple{Field{"sliced_weight",
                            &P::sliced_weight,
                            "weight of the sliced Wasserstein distance of patches",
                            "",
                            {0, 1e9}},
                      Field{"patch_sizes",
                            &P::patch_sizes,
                            "sides of these patches; of several, steps of adam take turns",
                            "pixels of the level",
                            {1, 64}},
                      Field{"positions",
                            &P::positions,
                            "positions of a picture's patches that a step compares; of more, a "
                            "random part about as large",
                            "",
                            {4096, 2147483647}}};
  }
};

/// Values that are projected at once: a larger picture is compared along fewer directions at a
/// time, so that memory grows with the picture alone. Not along too few: patches are gathered anew
/// each time, which costs as much as eight directions.
inline constexpr std::int64_t sliced_values_at_once = std::int64_t{1} << 23;
inline constexpr std::int64_t least_directions_at_once = 8;

/// Throws Error when the exemplar, or the result on an axis that does not wrap, is smaller than one
/// of the patches.
inline void check_patches_fit(const std::vector<int>& patch_sizes, Size exemplar, Size target,
                              Tile wraps) {
  const auto check = [](const char* what, Size size, Tile tile, int side) {
    if ((tiles_y(tile) || size.height >= side) && (tiles_x(tile) || size.width >= side)) return;
    throw Error("the {0} of {1}×{2} is too small for patches of {3}×{3}: make patch_sizes smaller",
                what, size.width, size.height, side);
  };
  for (const int side : patch_sizes) {
    check("exemplar", exemplar, Tile::none, side);
    check("texture", target, wraps, side);
  }
}

/// Directions that a picture of more than `positions` is compared along at a time.
inline constexpr std::int64_t sampled_directions_at_once = 32;

/// Both pictures are projected along each direction and sorted and, one of them, spread again; of
/// a large result samples are projected and counted, and all of it is projected and spread.
inline LossCost cost(const SlicedParams& params, const LossSize& size) {
  double taps = 0;
  for (const int side : params.patch_sizes)
    taps += static_cast<double>(side) * side * size.channels /
            static_cast<double>(params.patch_sizes.size());
  const double directions = size.directions, most = params.positions;
  const double exemplar = std::min(size.exemplar, most);
  const auto projected = [&](double positions) {
    return 2 * taps * directions * positions * operations_per_patch_operation;
  };
  if (size.result > most) {
    const double samples = exemplar + most;
    return {{.shared = directions * (size.result + samples) * seconds_per_counted_value,
             .operations = projected(2 * size.result + samples)},
            sizeof(float) * samples * std::min<double>(directions, sampled_directions_at_once)};
  }
  const double larger = std::max(size.result, exemplar);
  const double at_once =
      std::min<double>(directions, std::max(static_cast<double>(least_directions_at_once),
                                            static_cast<double>(sliced_values_at_once) / larger));
  const double keys = 16 * larger * std::min<double>(thread_count(), at_once);
  return {{.shared = directions * (size.result + 0.5 * exemplar) * seconds_per_sorted_value,
           .operations = projected(2 * size.result + exemplar)},
          sizeof(float) * 2 * at_once * larger + keys};
}

namespace neural {
class PictureTerm;
struct LossInput;
/// Throws Error when the exemplar or the result is smaller than a patch.
std::unique_ptr<PictureTerm> make_term(const SlicedParams& params, const LossInput& input);
}  // namespace neural

}  // namespace gramloom
