#pragma once

#include <memory>

#include "core/fields.h"
#include "neural/loss/loss_cost.h"

namespace gramloom {

/// The mean over channels of (V/V̂ − 1)², with V the total variation, the mean length of the
/// gradient: less grain than the exemplar has counts as much as more (Mahendran, Vedaldi 2015,
/// "Understanding deep image representations by inverting them", have V itself, which smooths).
struct VariationParams {
  static constexpr std::string_view name = "variation";
  double variation_weight = 0;

  double weight() const { return variation_weight; }
  static constexpr auto fields() {
    return std::tuple{Field{"variation_weight",
                            &VariationParams::variation_weight,
                            "weight of the total variation",
                            "",
                            {0, 1e9}}};
  }
};

inline LossCost cost(const VariationParams&, const LossSize& size) {
  return {{.shared = size.values() * seconds_per_transformed_value},
          sizeof(float) * 31 * size.values()};
}

namespace neural {
class PictureTerm;
struct LossInput;
std::unique_ptr<PictureTerm> make_term(const VariationParams& params, const LossInput& input);
}  // namespace neural

}  // namespace gramloom
