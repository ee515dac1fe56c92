#pragma once

#include "neural/loss/features.h"
#include "neural/params.h"

namespace gramloom::neural {

/// Those terms of `params` that look at a network, with the directions of Random(1).
inline std::vector<Features::Weighted> feature_terms(const NeuralParams& params,
                                                     const at::Tensor& exemplar) {
  std::vector<Features::Weighted> terms;
  const LossInput input{exemplar, {}, params.directions, Random(1)};
  for_each_term(params, [&]<class Params>(const Params& term) {
    if constexpr (LooksAtNetwork<Params>)
      terms.push_back({Params::name, term.weight(), make_term(term, input)});
  });
  return terms;
}

}  // namespace gramloom::neural
