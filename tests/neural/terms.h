#pragma once

#include "neural/loss/loss_term.h"
#include "neural/loss/terms.h"

namespace gramloom::neural {

/// A term that looks at the picture itself, with these parameters, for one exemplar and one size of
/// the result.
struct MadeTerm {
  template <class Params>
  MadeTerm(const Params& params, const at::Tensor& exemplar, Size target, Tile wraps,
           int directions = 8, Random random = Random(7))
      : term(make_term(params, LossInput{exemplar, {target, wraps}, directions, random})) {}

  double add(const at::Tensor& picture, double weight, std::uint64_t step,
             at::Tensor& gradient) const {
    return term->add(picture, weight, step, gradient);
  }
  double value(const at::Tensor& picture, std::uint64_t step = 0) const {
    at::Tensor gradient = at::zeros_like(picture);
    return add(picture, 1, step, gradient);
  }

  std::unique_ptr<PictureTerm> term;
};

}  // namespace gramloom::neural
