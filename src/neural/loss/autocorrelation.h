#pragma once

#include <memory>

#include "core/fields.h"
#include "neural/loss/loss_cost.h"

namespace gramloom {

/// Σ (A − Â)² / Σ Â² over the lags up to a quarter of the exemplar's sides (and less than half the
/// result's) but 0, of centred pictures: what repeats at a distance (Sendik, Cohen-Or 2017, "Deep
/// correlations for texture synthesis", take that of deep features).
struct AutocorrelationParams {
  static constexpr std::string_view name = "autocorrelation";
  double autocorrelation_weight = 0;

  double weight() const { return autocorrelation_weight; }
  static constexpr auto fields() {
    return std::tuple{Field{"autocorrelation_weight",
                            &AutocorrelationParams::autocorrelation_weight,
                            "weight of the autocorrelation up to a quarter of the exemplar",
                            "",
                            {0, 1e9}}};
  }
};

inline LossCost cost(const AutocorrelationParams&, const LossSize& size) {
  return {{.shared = size.values() * seconds_per_transformed_value},
          sizeof(float) * 31 * size.values()};
}

namespace neural {
class PictureTerm;
struct LossInput;
std::unique_ptr<PictureTerm> make_term(const AutocorrelationParams& params, const LossInput& input);
}  // namespace neural

}  // namespace gramloom
