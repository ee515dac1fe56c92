#include "neural/statistics.h"

#include <torch/csrc/autograd/custom_function.h>

namespace gramloom::neural {

namespace {

struct MomentsFunction : torch::autograd::Function<MomentsFunction> {
  // rows: (positions, channels)
  static torch::autograd::variable_list forward(torch::autograd::AutogradContext* context,
                                                const at::Tensor& rows) {
    context->save_for_backward({rows});
    const auto positions = static_cast<double>(rows.size(0));
    return {at::mm(rows.t(), rows).div_(positions), rows.mean(0)};
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 torch::autograd::variable_list gradients) {
    const at::Tensor rows = context->get_saved_variables()[0];
    const auto positions = static_cast<double>(rows.size(0));
    const at::Tensor& of_gram = gradients[0];
    const at::Tensor of_mean = gradients[1].unsqueeze(0).expand_as(rows);
    return {at::addmm(of_mean, rows, of_gram + of_gram.t(), 1 / positions, 1 / positions)};
  }
};

}  // namespace

Moments moments(const FeatureMaps& maps) {
  auto result = MomentsFunction::apply(to_rows(maps).contiguous());
  return {result[0], result[1]};
}

GramTarget::GramTarget(const Moments& exemplar, const GramOptions& options) : options_(options) {
  const at::NoGradGuard no_gradients;
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
  gram_ = transformed(exemplar);
  const double nothing = gram_.square().sum().item<double>();
  scale_ = options.normalise ? (nothing > 0 ? 1 / nothing : 0) : 1 / (4 * channels * channels);
}

at::Tensor GramTarget::transformed(const Moments& m) const {
  const at::Tensor cross = at::outer(mean_, m.mean);
  const at::Tensor centred = m.gram - cross - cross.t() + at::outer(mean_, mean_);
  return centred * at::outer(inverse_deviation_, inverse_deviation_);
}

at::Tensor GramTarget::distance(const Moments& result) const {
  at::Tensor error = (transformed(result) - gram_).square().sum();
  if (options_.centre)
    error = error + 2 * ((result.mean - mean_) * inverse_deviation_).square().sum();
  return error * scale_;
}

}  // namespace gramloom::neural
