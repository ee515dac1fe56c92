#pragma once

#include <memory>

#include "core/fields.h"
#include "neural/loss/loss_cost.h"

namespace gramloom {

/// The sliced Wasserstein distance between the values of the matched layers' feature maps at all
/// positions of a scale, along random directions in the space of channels (Heitz, Vanhoey,
/// Chambon, Belcour 2021, equations 4 to 6, with W₁ for W₂), divided by the exemplar's own distance
/// from its mean; averaged over the scales of a pyramid. Directions are those of the step.
struct SlicedFeaturesParams {
  static constexpr std::string_view name = "sliced_features";
  double sliced_features_weight = 0;

  double weight() const { return sliced_features_weight; }
  static constexpr auto fields() {
    using P = SlicedFeaturesParams;
    return std::tuple{Field{"sliced_features_weight",
                            &P::sliced_features_weight,
                            "weight of the sliced Wasserstein distance of a network's layers",
                            "",
                            {0, 1e9}}};
  }
};

/// Projections of both pictures' maps are sorted in each step, for which the network looks at the
/// exemplar again.
inline LossCost cost(const SlicedFeaturesParams&, const LossSize& size) {
  const double sorted = size.directions * (size.of_result.positions + size.of_exemplar.positions);
  return {{.shared = sorted * seconds_per_sorted_value, .operations = size.of_exemplar.filters / 2},
          3 * sizeof(float) * sorted};
}

namespace neural {
class FeatureTerm;
struct LossInput;
std::unique_ptr<FeatureTerm> make_term(const SlicedFeaturesParams& params, const LossInput& input);
}  // namespace neural

}  // namespace gramloom
