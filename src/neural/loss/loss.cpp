#include "neural/loss/loss.h"

#include "neural/settings.h"

namespace gramloom::neural {

Loss::Loss(const NeuralParams& params, const MatchedNetwork* network, const at::Tensor& exemplar,
           Edges exemplar_edges, const Target& target, Edges edges, Random random) {
  const c10::NoGradGuard no_gradients;
  if (needs_network(params))
    network_terms_.emplace(params, *network, exemplar, exemplar_edges, edges, random.stream(0));
  const auto add = [&](double weight, auto&& make) {
    if (weight > 0) picture_terms_.emplace_back(make(), weight);
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

double Loss::operator()(const at::Tensor& picture, std::uint64_t step, at::Tensor& gradient) {
  gradient.zero_();
  terms_ = network_terms_ ? network_terms_->add(picture, step, gradient) : std::vector<Term>{};
  for (const auto& [any, weight] : picture_terms_)
    std::visit(
        [&, w = weight](const auto& term) {
          terms_.push_back({std::string(term.name), w * term.add(picture, w, step, gradient)});
        },
        any);
  double total = 0;
  for (const auto& term : terms_) total += term.value;
  return total;
}

}  // namespace gramloom::neural
