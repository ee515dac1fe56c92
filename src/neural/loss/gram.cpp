#include "neural/loss/gram.h"

#include <torch/csrc/autograd/autograd.h>

#include "neural/loss/gram_target.h"
#include "neural/loss/loss_term.h"

namespace gramloom::neural {

namespace {

class GramTerm : public FeatureTerm {
 public:
  explicit GramTerm(const GramParams& params) : params_(params) {}

  std::vector<Rows> needed(const std::vector<Size>& sizes, const std::vector<Rows>& own,
                           Tile wraps) const override {
    return rows_for_moments(sizes, own, wraps, params_.shifts);
  }

  FeatureStatistics statistics(const SeenRows& rows, Tile wraps, std::uint64_t) const override {
    FeatureStatistics result;
    for (std::size_t l = 0; l < rows.maps.size(); ++l)
      result.moments.push_back(moments(rows.maps[l], rows.own[l], wraps, params_.shifts));
    return result;
  }

  void aim_at(FeatureStatistics exemplar) override {
    targets_.clear();
    for (const auto& moments : exemplar.moments) targets_.emplace_back(moments, params_);
  }
  bool aims_anew() const override { return false; }

  std::vector<double> compare(const FeatureStatistics& picture, const std::vector<double>& weights,
                              FeatureStatistics& slopes) const override {
    std::vector<double> errors;
    slopes.moments = picture.moments;
    for (std::size_t l = 0; l < targets_.size(); ++l)
      errors.push_back(compare_layer(targets_[l], weights[l], slopes.moments[l]));
    return errors;
  }

 private:
  // The weighted error of one layer, whose moments become their slopes.
  static double compare_layer(const GramTarget& target, double weight, Moments& moments) {
    std::vector<at::Tensor*> own{&moments.gram, &moments.mean};
    for (auto& shifted : moments.shifted) own.push_back(&shifted.products);
    std::vector<at::Tensor> leaves;
    for (at::Tensor* tensor : own)
      leaves.push_back(*tensor = tensor->detach().requires_grad_(true));
    const at::Tensor error = target.distance(moments) * weight;
    const auto slopes = torch::autograd::grad({error}, leaves, {}, {}, false, true);
    for (std::size_t i = 0; i < own.size(); ++i) *own[i] = slopes[i];
    return error.item<double>();
  }

  GramParams params_;
  std::vector<GramTarget> targets_;  // of each layer
};

}  // namespace

std::unique_ptr<FeatureTerm> make_term(const GramParams& params, const LossInput&) {
  return std::make_unique<GramTerm>(params);
}

}  // namespace gramloom::neural
