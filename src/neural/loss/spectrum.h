#pragma once

#include <memory>

#include "core/fields.h"
#include "neural/loss/loss_cost.h"

namespace gramloom {

/// Σ (|X| − |X̂|)² / Σ |X̂|² over all frequencies of centred pictures: the Fourier modulus (Liu,
/// Gousseau, Xia 2016, "Texture synthesis through convolutional neural networks and spectrum
/// constraints", equation 7). Departure: |X|² is the transform of the autocorrelation up to half
/// the exemplar's sides, faded out towards there: it serves results of any size, does not see where
/// the exemplar ends (the result is taken as if it tiled), and does not ask for the exemplar's very
/// frequencies, which another size may not have.
struct SpectrumParams {
  static constexpr std::string_view name = "spectrum";
  double spectrum_weight = 0.05;

  double weight() const { return spectrum_weight; }
  static constexpr auto fields() {
    return std::tuple{Field{"spectrum_weight",
                            &SpectrumParams::spectrum_weight,
                            "weight of the Fourier spectrum's modulus",
                            "",
                            {0, 1e9}}};
  }
};

/// Large pictures are transformed channel by channel.
inline LossCost cost(const SpectrumParams&, const LossSize& size) {
  return {{.shared = size.values() * seconds_per_transformed_value},
          sizeof(float) * (1 + 25.0 / size.channels) * size.values()};
}

namespace neural {
class PictureTerm;
struct LossInput;
std::unique_ptr<PictureTerm> make_term(const SpectrumParams& params, const LossInput& input);
}  // namespace neural

}  // namespace gramloom
