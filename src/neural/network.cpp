#include "neural/network.h"

#include <algorithm>
#include <cmath>

#include "neural/resample.h"

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

// The picture at half the size, rounded up; wrapped where it wraps.
at::Tensor halved(const at::Tensor& planes, Edges edges) {
  const auto half = [](std::int64_t side) { return static_cast<int>((side + 1) / 2); };
  return resample(planes, {half(planes.size(2)), half(planes.size(1))}, wrapped_axes(edges));
}

// One over each filter's mean activation over all positions of all scales; 1 for dead filters.
at::Tensor inverse_activation(const Scales& scales) {
  std::vector<at::Tensor> rows;
  for (const auto& maps : scales) rows.push_back(to_rows({at::relu(maps.data), maps.channels}));
  const at::Tensor mean = at::cat(rows).mean(0);
  return at::where(mean > 1e-12, 1 / mean, at::ones_like(mean));
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

std::vector<Scales> Network::filter(std::size_t index, const at::Tensor& picture,
                                    const Scales& before, Edges edges, bool relu) const {
  const auto smallest = [](Padding padding, std::int64_t radius) {
    return padding == Padding::valid ? 2 * radius + 1 : 1;
  };
  const auto one = [&](const Branch& branch, const at::Tensor& planes, const FeatureMaps* maps) {
    const std::int64_t radius = branch.convolution.radius();
    check_size(index, maps ? maps->height() : planes.size(1), maps ? maps->width() : planes.size(2),
               smallest(edges.y, radius), smallest(edges.x, radius), picture);
    if (maps && branch.blur == 0) return branch.convolution(*maps, edges, relu);
    return branch.convolution(blur(maps ? to_planes(*maps) : planes, branch.blur, edges), edges,
                              relu);
  };
  std::vector<Scales> result;
  at::Tensor planes = picture;
  for (const Branch& branch : branches_[index]) {
    Scales scales;
    for (const FeatureMaps& maps : before) scales.push_back(one(branch, {}, &maps));
    if (before.empty()) scales.push_back(one(branch, planes, nullptr));
    result.push_back(std::move(scales));
    if (is<PyramidLayer>(description_.layers[index])) planes = halved(planes, edges);
  }
  return result;
}

Scales Network::join(std::size_t index, std::vector<Scales> branches) const {
  Scales result;
  if (is<PyramidLayer>(description_.layers[index])) {
    for (auto& branch : branches) result.push_back(std::move(branch[0]));
  } else if (branches.size() == 1) {
    result = std::move(branches[0]);
  } else {
    for (std::size_t scale = 0; scale < branches[0].size(); ++scale) {
      std::vector<FeatureMaps> parts;
      for (const auto& branch : branches) parts.push_back(branch[scale]);
      crop_to_smallest(parts);
      result.push_back(concatenate(parts));
    }
  }
  return result;
}

Scales Network::apply(std::size_t index, const at::Tensor& picture, const Scales& before,
                      Edges edges, bool relu) const {
  if (!branches_[index].empty()) return join(index, filter(index, picture, before, edges, relu));
  const Layer& layer = description_.layers[index];
  const bool average = pooling_ == Pooling::average ||
                       (pooling_ == Pooling::as_described && is<AveragePoolLayer>(layer));
  Scales result = before.empty() ? Scales{to_maps(picture)} : before;
  for (auto& maps : result) {
    if (is<ReluLayer>(layer)) {
      maps.data = at::relu(maps.data);
    } else {
      check_size(index, maps.height(), maps.width(), 2, 2, picture);
      maps = pool(maps, average ? PoolKind::average : PoolKind::max);
    }
  }
  return result;
}

void Network::check_size(std::size_t layer, std::int64_t height, std::int64_t width,
                         std::int64_t least_height, std::int64_t least_width,
                         const at::Tensor& picture) const {
  if (height >= least_height && width >= least_width) return;
  throw Error("layer '{}' of network '{}' would be empty: a picture of {}×{} is too small for it",
              description_.layers[layer].name, description_.name, picture.size(2), picture.size(1));
}

std::vector<Scales> Network::operator()(const at::Tensor& picture, Edges edges,
                                        const std::vector<std::size_t>& wanted) const {
  std::vector<Scales> result;
  Scales maps;
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
  Scales maps;
  for (std::size_t layer = 0, i = 0; layer < description.layers.size(); ++layer) {
    // One layer at a time is a network of its own, so that no more than one is in memory twice.
    std::size_t count = 0;
    while (i + count < shapes.size() && shapes[i + count].layer == layer) ++count;
    const auto from = static_cast<std::ptrdiff_t>(i), to = static_cast<std::ptrdiff_t>(i + count);
    const Network network(description, {shapes.begin() + from, shapes.begin() + to},
                          {weights.begin() + from, weights.begin() + to}, pooling);
    if (count == 0) {
      maps = network.apply(layer, picture, maps, edges, false);
      continue;
    }
    auto branches = network.filter(layer, picture, maps, edges, false);
    for (std::size_t k = 0; k < count; ++k) {
      const at::Tensor factor = inverse_activation(branches[k]);
      auto& own = weights[i + k];
      own.weights = own.weights * factor.view({-1, 1, 1, 1});
      if (own.bias.defined()) own.bias = own.bias * factor;
      for (auto& scale : branches[k]) scale = to_maps(to_planes(scale) * factor.view({-1, 1, 1}));
    }
    maps = network.join(layer, std::move(branches));
    i += count;
  }
  return {description, shapes, std::move(weights), pooling};
}

}  // namespace gramloom::neural
