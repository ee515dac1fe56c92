#pragma once

#include <memory>
#include <vector>

#include "core/fields.h"
#include "neural/loss/loss_cost.h"

namespace gramloom {

/// The Gram matrices of the matched layers, G_l = F_l F_lᵀ, E_l = 1/(4 N_l² M_l²) Σ (G_l − Ĝ_l)²,
/// with F_l the N_l feature maps of layer l at M_l positions (Gatys, Ecker, Bethge 2015, "Texture
/// synthesis using convolutional neural networks", equations 1 to 4). G is divided by M, so that
/// exemplar and result may differ in size (equal to the paper when they don't). Departures, each by
/// its option:
///   centre:      F is replaced by F − μ̂ with the exemplar's means μ̂, and E gains the means'
///                difference, 2/(4 N²) Σ (μ − μ̂)², as if a constant map 1 had joined F;
///   standardise: each map is divided by its standard deviation on the exemplar (about 0 when
///                not centred);
///   shifts:      products of maps with shifted maps are compared like those of G (Brochard, Zhang,
///                Mallat 2022, see moments.h);
///   normalise:   E is divided by its value for G = 0, μ = μ̂, so that layers weigh alike.
struct GramParams {
  static constexpr std::string_view name = "gram";
  double gram_weight = 0;
  bool normalise = true;
  bool centre = true;
  bool standardise = true;
  std::vector<int> shifts;

  double weight() const { return gram_weight; }
  static constexpr auto fields() {
    using P = GramParams;
    return std::tuple{
        Field{"gram_weight",
              &P::gram_weight,
              "weight of the Gram matrices of a network's layers",
              "",
              {0, 1e9}},
        Field{"normalise", &P::normalise,
              "divide each layer's error by its value for the exemplar against nothing"},
        Field{"centre", &P::centre,
              "subtract each feature map's mean on the exemplar, and match means as a statistic"},
        Field{"standardise", &P::standardise,
              "divide each feature map by its standard deviation on the exemplar"},
        Field{"shifts",
              &P::shifts,
              "distances at which products of maps with shifted maps are matched too",
              "positions of the layer",
              {1, 256}}};
  }
};

/// The gradient needs each shifted copy of the maps, and both as rows.
inline LossCost cost(const GramParams& params, const LossSize& size) {
  const auto shifts = static_cast<double>(params.shifts.size());
  const NetworkWork& work = size.of_result;
  return {{.operations = 4 * (work.products + 4 * shifts * work.products_within_scales)},
          sizeof(float) * 1.5 * 4 * 3 * shifts * work.matched};
}

namespace neural {
class FeatureTerm;
struct LossInput;
std::unique_ptr<FeatureTerm> make_term(const GramParams& params, const LossInput& input);
}  // namespace neural

}  // namespace gramloom
