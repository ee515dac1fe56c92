#include "neural/loss/sliced_features.h"

#include "neural/loss/loss_term.h"
#include "neural/loss/wasserstein.h"

namespace gramloom::neural {

namespace {

class SlicedFeaturesTerm : public FeatureTerm {
 public:
  SlicedFeaturesTerm(int directions, Random random) : directions_(directions), random_(random) {}

  FeatureStatistics statistics(const SeenRows& rows, Tile, std::uint64_t step) const override {
    FeatureStatistics result;
    for (std::size_t l = 0; l < rows.maps.size(); ++l)
      for (std::size_t k = 0; k < rows.maps[l].size(); ++k) {
        const HeldRows& maps = rows.maps[l][k];
        const at::Tensor positions =
            to_rows({take_rows(maps, rows.own[l][k], Padding::circular), maps.channels});
        const Random own = random_.stream(step).stream(result.values.size());
        result.values.push_back(
            at::mm(random_directions(own, directions_, maps.channels), positions.t()));
      }
    return result;
  }

  void aim_at(FeatureStatistics exemplar) override {
    goals_ = std::move(exemplar.values);
    for (auto& values : goals_) sort_rows(values);
    for (std::size_t i = flat_.size(); i < goals_.size(); ++i) {
      const double flat = distance_from_mean(goals_[i]) / directions_;
      // Of equal values the mean is rounded.
      const double size = goals_[i].square().mean().sqrt().item<double>();
      flat_.push_back(flat < 1e-6 * size ? 0 : flat);
    }
  }
  bool aims_anew() const override { return true; }

  std::vector<double> compare(const FeatureStatistics& picture, const std::vector<double>& weights,
                              FeatureStatistics& slopes) const override {
    std::vector<double> errors(weights.size());
    const std::size_t scales = goals_.size() / weights.size();
    for (std::size_t i = 0; i < goals_.size(); ++i) {
      at::Tensor values = picture.values[i];  // overwritten, where no gradient needs them
      if (values.requires_grad()) values = values.detach().clone(at::MemoryFormat::Contiguous);
      const std::size_t layer = i / scales;
      const double weight =
          flat_[i] > 0 ? weights[layer] / (flat_[i] * static_cast<double>(scales)) : 0;
      errors[layer] += weight * wasserstein(values, goals_[i], weight);
      slopes.values.push_back(values);
    }
    return errors;
  }

 private:
  int directions_;
  Random random_;
  std::vector<at::Tensor> goals_;  // the exemplar's values of each layer and scale, sorted
  std::vector<double> flat_;       // the mean distance of each from its mean, in the first step
};

}  // namespace

std::unique_ptr<FeatureTerm> make_term(const SlicedFeaturesParams&, const LossInput& input) {
  return std::make_unique<SlicedFeaturesTerm>(input.directions, input.random.stream(0));
}

}  // namespace gramloom::neural
