#include "neural/statistics.h"

#include <torch/csrc/autograd/custom_function.h>

#include "neural/resample.h"

namespace gramloom::neural {

namespace {

// Keeps the maps, which the network keeps anyway, and not their copy in rows.
struct MomentsFunction : torch::autograd::Function<MomentsFunction> {
  static torch::autograd::variable_list forward(torch::autograd::AutogradContext* context,
                                                const at::Tensor& data, std::int64_t channels) {
    context->save_for_backward({data});
    context->saved_data["channels"] = channels;
    const at::Tensor rows = to_rows({data, channels}).contiguous();
    const auto positions = static_cast<double>(rows.size(0));
    return {at::mm(rows.t(), rows).div_(positions), rows.mean(0)};
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 torch::autograd::variable_list gradients) {
    const at::Tensor data = context->get_saved_variables()[0];
    const auto channels = context->saved_data["channels"].toInt();
    const at::Tensor rows = to_rows({data, channels}).contiguous();
    const auto positions = static_cast<double>(rows.size(0));
    const at::Tensor& of_gram = gradients[0];
    const at::Tensor of_rows =
        at::addmm(gradients[1], rows, of_gram + of_gram.t(), 1 / positions, 1 / positions);
    // Back into blocks: the transpose of to_rows().
    at::Tensor blocks = at::constant_pad_nd(of_rows, {0, data.size(0) * data.size(3) - channels});
    return {blocks.view({data.size(1), data.size(2), data.size(0), data.size(3)})
                .permute({2, 0, 1, 3})
                .contiguous(),
            at::Tensor()};
  }
};

}  // namespace

Moments moments(const FeatureMaps& maps) {
  auto result = MomentsFunction::apply(maps.data, maps.channels);
  return {result[0], result[1]};
}

Moments moments(const Scales& scales, Tile tile) {
  if (scales.size() == 1) return moments(scales[0]);
  std::vector<FeatureMaps> finer;  // maps of finer scales, averaged to the present one's positions
  std::vector<at::Tensor> means;
  std::vector<std::vector<at::Tensor>> blocks(scales.size());  // of the Gram matrix
  for (std::size_t k = 0; k < scales.size(); ++k) {
    const Size size{static_cast<int>(scales[k].width()), static_cast<int>(scales[k].height())};
    for (auto& maps : finer) maps = shrink(maps, size, tile);
    const Moments own = moments(scales[k]);
    means.push_back(own.mean);
    if (k > 0) {
      const at::Tensor rows = to_rows(scales[k]);
      for (std::size_t j = 0; j < k; ++j) {
        const at::Tensor cross =
            at::mm(rows.t(), to_rows(finer[j])) / static_cast<double>(rows.size(0));
        blocks[k].push_back(cross);
        blocks[j].push_back(cross.t());
      }
    }
    blocks[k].push_back(own.gram);
    finer.push_back(scales[k]);
  }
  std::vector<at::Tensor> rows;
  for (const auto& row : blocks) rows.push_back(at::cat(row, 1));
  return {at::cat(rows), at::cat(means)};
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
