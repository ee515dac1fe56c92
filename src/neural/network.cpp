#include "neural/network.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace gramloom::neural {

namespace {

template <class T>
bool is(const Layer& layer) {
  return std::holds_alternative<T>(layer.kind);
}

// Gaussian blur of (channels, height, width), one axis at a time.
at::Tensor blur(const at::Tensor& planes, double deviation, Edges edges) {
  if (deviation <= 0) return planes;
  const auto radius = static_cast<std::int64_t>(std::ceil(3 * deviation));
  const at::Tensor x = at::arange(-radius, radius + 1, planes.options());
  at::Tensor kernel = at::exp(x * x / (-2 * deviation * deviation));
  kernel = (kernel / kernel.sum()).view({1, 1, 1, -1});
  // Valid edges would shrink this branch more than its fellows: reflect them instead.
  if (edges.x == Padding::valid) edges.x = Padding::reflect;
  if (edges.y == Padding::valid) edges.y = Padding::reflect;
  const at::Tensor padded = pad_planes(planes, radius, edges).unsqueeze(1);
  return at::conv2d(at::conv2d(padded, kernel), kernel.transpose(2, 3)).squeeze(1);
}

// Cuts maps of several branches to the smallest of them, around their centres.
void crop_to_smallest(std::vector<FeatureMaps>& parts) {
  std::int64_t height = parts[0].height(), width = parts[0].width();
  for (const auto& part : parts) {
    height = std::min(height, part.height());
    width = std::min(width, part.width());
  }
  for (auto& part : parts)
    part.data = part.data.narrow(1, (part.height() - height) / 2, height)
                    .narrow(2, (part.width() - width) / 2, width);
}

}  // namespace

Network::Network(const NetworkDescription& description, std::vector<FilterShape> shapes,
                 std::vector<FilterWeights> weights, Pooling pooling)
    : description_(description),
      shapes_(std::move(shapes)),
      weights_(std::move(weights)),
      pooling_(pooling),
      first_(description.layers.size(), 0) {
  for (std::size_t i = shapes_.size(); i-- > 0;) first_[shapes_[i].layer] = i;
  build();
}

void Network::build() {
  convolutions_.clear();
  for (std::size_t i = 0; i < shapes_.size(); ++i)
    convolutions_.emplace_back(weights_[i].weights, weights_[i].bias, shapes_[i].dilation);
}

FeatureMaps Network::apply(std::size_t index, const at::Tensor& planes, const FeatureMaps& maps,
                           Edges edges, bool relu) const {
  const Layer& layer = description_.layers[index];
  const bool first = !maps.data.defined();  // nothing but the picture so far
  const auto extent = [&](std::int64_t size, Padding padding, std::int64_t radius) {
    return size - (padding == Padding::valid ? 2 * radius : 0);
  };
  const std::int64_t height = first ? planes.size(1) : maps.height();
  const std::int64_t width = first ? planes.size(2) : maps.width();
  const auto check = [&](std::int64_t h, std::int64_t w) {
    if (h < 1 || w < 1)
      throw Error(
          "layer '{}' of network '{}' would be empty: a picture of {}×{} is too small for it",
          layer.name, description_.name, planes.size(2), planes.size(1));
  };

  if (is<ConvolutionLayer>(layer) || is<BankLayer>(layer)) {
    std::vector<FeatureMaps> parts;
    const at::Tensor input = first ? planes : to_planes(maps);
    for (std::size_t i = first_[index]; i < shapes_.size() && shapes_[i].layer == index; ++i) {
      const auto& convolution = convolutions_[i];
      check(extent(height, edges.y, convolution.radius()),
            extent(width, edges.x, convolution.radius()));
      if (first || shapes_[i].blur > 0)
        parts.push_back(convolution(blur(input, shapes_[i].blur, edges), edges, relu));
      else
        parts.push_back(convolution(maps, edges, relu));
    }
    if (parts.size() == 1) return parts[0];
    crop_to_smallest(parts);
    return concatenate(parts);
  }
  const FeatureMaps& input = first ? to_maps(planes) : maps;
  if (is<ReluLayer>(layer)) return {at::relu(input.data), input.channels};
  check(height / 2, width / 2);
  const bool average = pooling_ == Pooling::average ||
                       (pooling_ == Pooling::as_described && is<AveragePoolLayer>(layer));
  return pool(input, average ? PoolKind::average : PoolKind::max);
}

std::vector<FeatureMaps> Network::operator()(const at::Tensor& planes, Edges edges,
                                             const std::vector<std::size_t>& wanted) const {
  std::vector<FeatureMaps> result;
  FeatureMaps maps;
  for (std::size_t i = 0; result.size() < wanted.size(); ++i) {
    const bool asked_for = wanted[result.size()] == i;
    const bool filters =
        is<ConvolutionLayer>(description_.layers[i]) || is<BankLayer>(description_.layers[i]);
    const bool fuse = filters && !asked_for && i + 1 < description_.layers.size() &&
                      is<ReluLayer>(description_.layers[i + 1]);
    maps = apply(i, planes, maps, edges, fuse);
    if (fuse) ++i;
    if (wanted[result.size()] == i) result.push_back(maps);
  }
  return result;
}

void Network::rescale(const at::Tensor& planes, Edges edges) {
  const at::NoGradGuard no_gradients;
  FeatureMaps maps;
  for (std::size_t layer = 0; layer < description_.layers.size(); ++layer) {
    maps = apply(layer, planes, maps, edges, false);
    if (!is<ConvolutionLayer>(description_.layers[layer]) &&
        !is<BankLayer>(description_.layers[layer]))
      continue;
    const at::Tensor mean = to_rows({at::relu(maps.data), maps.channels}).mean(0);
    const at::Tensor factor = at::where(mean > 1e-12, 1 / mean, at::ones_like(mean));
    std::int64_t channel = 0;
    for (std::size_t i = first_[layer]; i < shapes_.size() && shapes_[i].layer == layer; ++i) {
      const at::Tensor part = factor.narrow(0, channel, shapes_[i].outputs);
      weights_[i].weights = weights_[i].weights * part.view({-1, 1, 1, 1});
      if (weights_[i].bias.defined()) weights_[i].bias = weights_[i].bias * part;
      channel += shapes_[i].outputs;
    }
    maps = to_maps(to_planes(maps) * factor.view({-1, 1, 1}));
  }
  build();
}

}  // namespace gramloom::neural
