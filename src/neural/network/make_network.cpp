#include "neural/network/make_network.h"

#include <algorithm>

namespace gramloom::neural {

namespace {

// All feature maps of the picture that filters are rescaled on are in memory; mean activations on a
// quarter of a million positions are exact enough.
constexpr std::int64_t largest_side_to_rescale = 512;

at::Tensor middle(const at::Tensor& planes, std::int64_t side) {
  const std::int64_t height = std::min(side, planes.size(1)),
                     width = std::min(side, planes.size(2));
  return planes.narrow(1, (planes.size(1) - height) / 2, height)
      .narrow(2, (planes.size(2) - width) / 2, width)
      .contiguous();
}

}  // namespace

Network make_network(const NeuralParams& params, const NetworkDescription& description,
                     const at::Tensor& exemplar) {
  const int channels = static_cast<int>(exemplar.size(0));
  const auto shapes = filter_shapes(description, channels);
  if (params.weights.empty()) {
    auto filters = random_filters(shapes, params.random_weights,
                                  static_cast<std::uint64_t>(params.weights_seed));
    if (!params.rescale) return {description, shapes, std::move(filters), params.pooling};
    return Network::rescaled(description, shapes, std::move(filters), params.pooling,
                             middle(exemplar, largest_side_to_rescale),
                             {params.exemplar_padding, params.exemplar_padding});
  }
  return {description, shapes, load_filters(description, shapes, params.weights), params.pooling};
}

}  // namespace gramloom::neural
