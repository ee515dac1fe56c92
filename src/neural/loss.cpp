#include "neural/loss.h"

#include <torch/csrc/autograd/autograd.h>

namespace gramloom::neural {

Loss::Loss(const Network& network, const NetworkDescription& description,
           std::vector<MatchedLayer> layers, const GramOptions& options, const at::Tensor& exemplar,
           Edges exemplar_edges, Edges edges)
    : network_(network), edges_(edges) {
  const at::NoGradGuard no_gradients;
  for (const auto& layer : layers) {
    wanted_.push_back(layer.index);
    weights_.push_back(layer.weight);
    terms_.push_back({description.layers[layer.index].name, 0});
  }
  for (const auto& maps : network_(exemplar, exemplar_edges, wanted_))
    targets_.emplace_back(moments(maps, wrapped_axes(exemplar_edges)), options);
}

double Loss::operator()(const at::Tensor& picture, at::Tensor& gradient) {
  const at::AutoGradMode gradients(true);
  const at::Tensor x = picture.detach().requires_grad_(true);
  at::Tensor total = at::zeros({}, x.options());
  {
    const auto maps = network_(x, edges_, wanted_);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const at::Tensor term =
          targets_[i].distance(moments(maps[i], wrapped_axes(edges_))) * weights_[i];
      terms_[i].value = term.item<double>();
      total = total + term;
    }
  }
  gradient.copy_(torch::autograd::grad({total}, {x})[0]);
  return total.item<double>();
}

}  // namespace gramloom::neural
