#include "neural/network.h"

#include <algorithm>
#include <cmath>

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

Network::Network(const NetworkDescription& description, const std::vector<FilterShape>& shapes,
                 std::vector<FilterWeights> weights, Pooling pooling)
    : description_(description), pooling_(pooling), branches_(description.layers.size()) {
  for (std::size_t i = 0; i < shapes.size(); ++i)
    branches_[shapes[i].layer].push_back(
        {Convolution(std::move(weights[i].weights), std::move(weights[i].bias), shapes[i].dilation),
         shapes[i].blur});
}

FeatureMaps Network::filter(std::size_t index, const at::Tensor& picture, const FeatureMaps& maps,
                            Edges edges, bool relu) const {
  const bool first = !maps.data.defined();  // nothing but the picture so far
  const auto smallest = [](Padding padding, std::int64_t radius) {
    return padding == Padding::valid ? 2 * radius + 1 : 1;
  };
  std::vector<FeatureMaps> parts;
  for (const auto& [convolution, blur_deviation] : branches_[index]) {
    check_size(index, first ? picture.size(1) : maps.height(),
               first ? picture.size(2) : maps.width(), smallest(edges.y, convolution.radius()),
               smallest(edges.x, convolution.radius()), picture);
    if (first || blur_deviation > 0)
      parts.push_back(
          convolution(blur(first ? picture : to_planes(maps), blur_deviation, edges), edges, relu));
    else
      parts.push_back(convolution(maps, edges, relu));
  }
  if (parts.size() == 1) return parts[0];
  crop_to_smallest(parts);
  return concatenate(parts);
}

FeatureMaps Network::apply(std::size_t index, const at::Tensor& picture, const FeatureMaps& maps,
                           Edges edges, bool relu) const {
  if (!branches_[index].empty()) return filter(index, picture, maps, edges, relu);
  const FeatureMaps input = maps.data.defined() ? maps : to_maps(picture);
  const Layer& layer = description_.layers[index];
  if (is<ReluLayer>(layer)) return {at::relu(input.data), input.channels};
  check_size(index, input.height(), input.width(), 2, 2, picture);
  const bool average = pooling_ == Pooling::average ||
                       (pooling_ == Pooling::as_described && is<AveragePoolLayer>(layer));
  return pool(input, average ? PoolKind::average : PoolKind::max);
}

void Network::check_size(std::size_t layer, std::int64_t height, std::int64_t width,
                         std::int64_t least_height, std::int64_t least_width,
                         const at::Tensor& picture) const {
  if (height >= least_height && width >= least_width) return;
  throw Error("layer '{}' of network '{}' would be empty: a picture of {}×{} is too small for it",
              description_.layers[layer].name, description_.name, picture.size(2), picture.size(1));
}

std::vector<FeatureMaps> Network::operator()(const at::Tensor& picture, Edges edges,
                                             const std::vector<std::size_t>& wanted) const {
  std::vector<FeatureMaps> result;
  FeatureMaps maps;
  for (std::size_t i = 0; result.size() < wanted.size(); ++i) {
    const bool fuse = !branches_[i].empty() && wanted[result.size()] != i &&
                      i + 1 < description_.layers.size() &&
                      is<ReluLayer>(description_.layers[i + 1]);
    maps = apply(i, picture, maps, edges, fuse);
    if (fuse) ++i;
    if (wanted[result.size()] == i) result.push_back(maps);
  }
  return result;
}

Network Network::rescaled(const NetworkDescription& description,
                          const std::vector<FilterShape>& shapes,
                          std::vector<FilterWeights> weights, Pooling pooling,
                          const at::Tensor& picture, Edges edges) {
  const at::NoGradGuard no_gradients;
  FeatureMaps maps;
  for (std::size_t layer = 0, i = 0; layer < description.layers.size(); ++layer) {
    // One layer at a time is a network of its own, so that no more than one is in memory twice.
    std::vector<FilterShape> own;
    std::vector<FilterWeights> filters;
    const std::size_t first = i;
    for (; i < shapes.size() && shapes[i].layer == layer; ++i) {
      own.push_back(shapes[i]);
      filters.push_back(weights[i]);
    }
    const Network network(description, own, filters, pooling);
    maps = network.apply(layer, picture, maps, edges, false);
    if (own.empty()) continue;
    const at::Tensor mean = to_rows({at::relu(maps.data), maps.channels}).mean(0);
    const at::Tensor factor = at::where(mean > 1e-12, 1 / mean, at::ones_like(mean));
    std::int64_t channel = 0;
    for (std::size_t k = first; k < i; ++k) {
      const at::Tensor part = factor.narrow(0, channel, shapes[k].outputs);
      weights[k].weights = weights[k].weights * part.view({-1, 1, 1, 1});
      if (weights[k].bias.defined()) weights[k].bias = weights[k].bias * part;
      channel += shapes[k].outputs;
    }
    maps = to_maps(to_planes(maps) * factor.view({-1, 1, 1}));
  }
  return {description, shapes, std::move(weights), pooling};
}

}  // namespace gramloom::neural
