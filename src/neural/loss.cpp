#include "neural/loss.h"

#include <torch/csrc/autograd/autograd.h>

namespace gramloom::neural {

Loss::Loss(const NeuralParams& params, const MatchedNetwork* network, const at::Tensor& exemplar,
           Edges exemplar_edges, const Target& target, Edges edges, Random random)
    : network_(network),
      options_{params.normalise, params.centre, params.standardise, params.shifts},
      gram_weight_(params.gram_weight),
      edges_(edges) {
  const at::NoGradGuard no_gradients;
  if (gram_weight_ > 0) {
    for (const auto& layer : network->layers) {
      wanted_.push_back(layer.index);
      terms_.push_back({network->description.layers[layer.index].name, 0});
    }
    for (const auto& maps : network->network(exemplar, exemplar_edges, wanted_))
      targets_.emplace_back(moments(maps, wrapped_axes(exemplar_edges), params.shifts), options_);
  }
  const auto add = [&](double weight, auto&& make) {
    if (weight <= 0) return;
    others_.emplace_back(make(), weight);
    std::visit(
        [&](const auto& term) {
          terms_.push_back({std::string(term.name), 0});
        },
        others_.back().first);
  };
  add(params.sliced_weight, [&] {
    return SlicedTerm(exemplar, target.size, target.tile, params.patch_sizes, params.directions,
                      random);
  });
  add(params.spectrum_weight, [&] { return SpectrumTerm(exemplar, target.size); });
  add(params.autocorrelation_weight,
      [&] { return AutocorrelationTerm(exemplar, target.size, target.tile); });
  add(params.variation_weight, [&] { return VariationTerm(exemplar, target.tile); });
}

double Loss::add_grams(const at::Tensor& picture, at::Tensor& gradient) {
  const at::AutoGradMode gradients(true);
  const at::Tensor x = picture.detach().requires_grad_(true);
  at::Tensor total = at::zeros({}, x.options());
  const auto maps = network_->network(x, edges_, wanted_);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const at::Tensor term =
        targets_[i].distance(moments(maps[i], wrapped_axes(edges_), options_.shifts)) *
        (network_->layers[i].weight * gram_weight_);
    terms_[i].value = term.item<double>();
    total = total + term;
  }
  gradient.add_(torch::autograd::grad({total}, {x})[0]);
  return total.item<double>();
}

double Loss::operator()(const at::Tensor& picture, std::uint64_t step, at::Tensor& gradient) {
  gradient.zero_();
  double total = targets_.empty() ? 0 : add_grams(picture, gradient);
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const auto& [term, weight] = others_[i];
    const double value =
        weight *
        std::visit([&, w = weight](const auto& own) { return own.add(picture, w, step, gradient); },
                   term);
    terms_[targets_.size() + i].value = value;
    total += value;
  }
  return total;
}

}  // namespace gramloom::neural
