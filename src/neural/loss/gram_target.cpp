#include "neural/loss/gram_target.h"

#include <c10/core/GradMode.h>

#include <tuple>

namespace gramloom::neural {

GramTarget::GramTarget(const Moments& exemplar, const GramParams& options) : options_(options) {
  const c10::NoGradGuard no_gradients;
  const auto channels = static_cast<double>(exemplar.mean.size(0));
  mean_ = options.centre ? exemplar.mean.clone() : at::zeros_like(exemplar.mean);
  inverse_deviation_ = at::ones_like(mean_);
  if (options.standardise) {
    const at::Tensor second = exemplar.gram.diagonal();
    // Rounding of E[f²] − E[f]² leaves noise where a map is flat: such a map is left out.
    const at::Tensor variance = second - mean_ * mean_;
    inverse_deviation_ = at::where(variance > second * 1e-6, variance.clamp_min(1e-30).rsqrt(),
                                   at::zeros_like(mean_));
  }
  gram_ = transformed(exemplar.gram, exemplar, 0);
  double nothing = gram_.square().sum().item<double>();
  for (const auto& [first, dy, dx, products] : exemplar.shifted) {
    shifted_.push_back({first, dy, dx, transformed(products, exemplar, first)});
    nothing += shifted_.back().products.square().sum().item<double>();
  }
  scale_ = options.normalise ? (nothing > 0 ? 1 / nothing : 0) : 1 / (4 * channels * channels);
}

at::Tensor GramTarget::transformed(const at::Tensor& products, const Moments& m,
                                   std::int64_t first) const {
  const auto own = [&](const at::Tensor& of_all) {
    return of_all.narrow(0, first, products.size(0));
  };
  const at::Tensor mean = own(mean_), scale = own(inverse_deviation_);
  const at::Tensor cross = at::outer(mean, own(m.mean));
  const at::Tensor centred = products - cross - cross.t() + at::outer(mean, mean);
  return centred * at::outer(scale, scale);
}

at::Tensor GramTarget::distance(const Moments& result) const {
  at::Tensor error = (transformed(result.gram, result, 0) - gram_).square().sum();
  for (const auto& own : result.shifted)  // those that both pictures are large enough for
    for (const auto& goal : shifted_)
      if (std::tie(own.first, own.dy, own.dx) == std::tie(goal.first, goal.dy, goal.dx))
        error =
            error + (transformed(own.products, result, own.first) - goal.products).square().sum();
  if (options_.centre)
    error = error + 2 * ((result.mean - mean_) * inverse_deviation_).square().sum();
  return error * scale_;
}

}  // namespace gramloom::neural
