#include "neural/loss/loss.h"

#include <c10/core/GradMode.h>

namespace gramloom::neural {

Loss::Loss(const NeuralParams& params, const MatchedNetwork* network, const at::Tensor& exemplar,
           Edges exemplar_edges, const Target& target, Edges edges, Random random,
           const Guidance* guidance, const at::Tensor& nearest, const Group& group)
    : group_(group), height_(target.size.height) {
  const c10::NoGradGuard no_gradients;
  const LossInput input{exemplar, target, params.directions, random, guidance, nearest, group};
  std::vector<Features::Weighted> of_features;
  for_each_term(params, [&]<class Params>(const Params& term) {
    if constexpr (LooksAtNetwork<Params>)
      of_features.push_back({Params::name, term.weight(), make_term(term, input)});
    else
      pictures_.push_back({Params::name, term.weight(), make_term(term, input)});
  });
  if (!of_features.empty())
    features_.emplace(*network, std::move(of_features), exemplar, exemplar_edges, edges,
                      most_positions_at_once, group);
}

double Loss::operator()(const at::Tensor& picture, std::uint64_t step, at::Tensor& gradient) {
  gradient.zero_();
  terms_.clear();
  if (features_) terms_ = features_->add(held_by(group_, picture, height_), step, gradient);
  for (const auto& [name, weight, term] : pictures_)
    terms_.push_back({std::string(name), weight * term->add(picture, weight, step, gradient)});
  // On other processors the last bits may be others, but all must decide alike.
  std::vector<double> values;
  for (const auto& term : terms_) values.push_back(term.value);
  group_.first(std::span(values));
  double total = 0;
  for (std::size_t i = 0; i < values.size(); ++i) total += terms_[i].value = values[i];
  return total;
}

}  // namespace gramloom::neural
