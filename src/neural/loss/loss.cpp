#include "neural/loss/loss.h"

#include <c10/core/GradMode.h>

namespace gramloom::neural {

Loss::Loss(const NeuralParams& params, const MatchedNetwork* network, const at::Tensor& exemplar,
           Edges exemplar_edges, const Target& target, Edges edges, Random random,
           const Guidance* guidance, const at::Tensor& nearest) {
  const c10::NoGradGuard no_gradients;
  const LossInput input{exemplar, target, params.directions, random, guidance, nearest};
  std::vector<Features::Weighted> of_features;
  for_each_term(params, [&]<class Params>(const Params& term) {
    if constexpr (LooksAtNetwork<Params>)
      of_features.push_back({Params::name, term.weight(), make_term(term, input)});
    else
      pictures_.push_back({Params::name, term.weight(), make_term(term, input)});
  });
  if (!of_features.empty())
    features_.emplace(*network, std::move(of_features), exemplar, exemplar_edges, edges);
}

double Loss::operator()(const at::Tensor& picture, std::uint64_t step, at::Tensor& gradient) {
  gradient.zero_();
  terms_ = features_ ? features_->add(picture, step, gradient) : std::vector<Term>{};
  for (const auto& [name, weight, term] : pictures_)
    terms_.push_back({std::string(name), weight * term->add(picture, weight, step, gradient)});
  double total = 0;
  for (const auto& term : terms_) total += term.value;
  return total;
}

}  // namespace gramloom::neural
