#include "neural/network/network.h"

#include <c10/core/GradMode.h>

#include <algorithm>
#include <cmath>

#include "neural/resample.h"

namespace gramloom::neural {

namespace {

template <class T>
bool is(const NetworkLayer& layer) {
  return std::holds_alternative<T>(layer.kind);
}

std::int64_t blur_radius(double deviation) {
  return static_cast<std::int64_t>(std::ceil(3 * deviation));
}

// What a blur sees beyond the edges. Valid edges would shrink its branch more than its fellows.
Padding of_blur(Padding padding) { return padding == Padding::valid ? Padding::reflect : padding; }

// Gaussian blur of (channels, rows, width), one axis at a time; rows that see beyond the first or
// the last one are left out.
at::Tensor blur(const at::Tensor& planes, double deviation, Padding padding_x) {
  const std::int64_t radius = blur_radius(deviation);
  const at::Tensor x = at::arange(-radius, radius + 1, planes.options());
  at::Tensor kernel = at::exp(x * x / (-2 * deviation * deviation));
  kernel = (kernel / kernel.sum()).view({1, 1, 1, -1});
  const at::Tensor padded = pad_planes(planes, radius, {padding_x, Padding::valid}).unsqueeze(1);
  return at::conv2d(at::conv2d(padded, kernel), kernel.transpose(2, 3)).squeeze(1);
}

// Cuts the maps of branches on which valid edges took more or fewer columns to the fewest, in the
// middle.
void crop_to_narrowest(std::vector<FeatureMaps>& parts) {
  std::int64_t width = parts[0].width();
  for (const auto& part : parts) width = std::min(width, part.width());
  for (auto& part : parts) part.data = part.data.narrow(2, (part.width() - width) / 2, width);
}

// One over each filter's mean activation over all positions of all scales; 1 for dead filters.
at::Tensor inverse_activation(const std::vector<HeldRows>& scales) {
  std::vector<at::Tensor> rows;
  for (const auto& held : scales) rows.push_back(to_rows({at::relu(held.data), held.channels}));
  const at::Tensor mean = at::cat(rows).mean(0);
  return at::where(mean > 1e-12, 1 / mean, at::ones_like(mean));
}

// The rows that rows of a pooled picture are made of, for each turn around the circle: an odd last
// row is left out every time.
std::vector<Rows> turns(Rows rows, std::int64_t height, std::int64_t own_height) {
  std::vector<Rows> result;
  while (!rows.empty()) {
    const std::int64_t turn = floor_divided(rows.begin, own_height);
    const std::int64_t end = std::min(rows.end, (turn + 1) * own_height);
    const std::int64_t left_out = turn * (height - 2 * own_height);
    result.push_back({2 * rows.begin + left_out, 2 * end + left_out});
    rows.begin = end;
  }
  return result;
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

bool Network::is_pyramid(std::size_t layer) const {
  return is<PyramidLayer>(description_.layers[layer]);
}

std::span<const Network::Branch> Network::branches(std::size_t layer, std::size_t scale) const {
  const std::span all(branches_[layer]);
  return is_pyramid(layer) ? all.subspan(scale, 1) : all;
}

std::int64_t Network::radius(std::size_t layer) const {
  std::int64_t result = 0;
  for (const Branch& branch : branches_[layer])
    result = std::max(result, branch.convolution.radius());
  return result;
}

std::vector<at::Tensor> Network::scales(const at::Tensor& picture, Edges edges) const {
  std::vector<at::Tensor> result;
  for (const Size size : scale_sizes(size_of(picture)))
    result.push_back(result.empty() ? picture : resample(result.back(), size, wrapped_axes(edges)));
  return result;
}

std::vector<Size> Network::scale_sizes(Size picture) const {
  std::vector<Size> result{picture};
  if (is_pyramid(0))  // half the size, rounded up
    while (result.size() < branches_[0].size())
      result.push_back({(result.back().width + 1) / 2, (result.back().height + 1) / 2});
  return result;
}

std::vector<Size> Network::sizes(Size scale, Edges edges) const {
  return map_sizes(description_, scale,
                   wrapping(edges.x == Padding::valid, edges.y == Padding::valid));
}

Rows Network::inputs(std::size_t layer, Rows rows, std::int64_t height, std::int64_t own_height,
                     Edges edges) const {
  Rows result;
  if (!branches_[layer].empty()) {
    const std::int64_t lost = edges.y == Padding::valid ? radius(layer) : 0;
    for (const Branch& branch : branches_[layer]) {
      const std::int64_t r = branch.convolution.radius(), b = blur_radius(branch.blur);
      const Rows seen = rows_behind({rows.begin + lost - r, rows.end + lost + r}, height, edges.y);
      result = hull(result, rows_behind({seen.begin - b, seen.end + b}, height, of_blur(edges.y)));
    }
  } else if (is<ReluLayer>(description_.layers[layer])) {
    result = rows;
  } else {
    for (const auto& turn : turns(rows, height, own_height)) result = hull(result, turn);
  }
  return rows_behind(result, height, edges.y);
}

std::vector<Rows> Network::needed(const std::vector<Size>& sizes, Edges edges,
                                  const std::vector<std::size_t>& wanted,
                                  const std::vector<Rows>& rows) const {
  std::vector<Rows> result(wanted.back() + 1);
  for (std::size_t i = 0; i < wanted.size(); ++i) result[wanted[i]] = rows[i];
  for (std::size_t i = result.size(); i-- > 1;) {
    const std::int64_t before = sizes[i - 1].height;
    result[i - 1] = rows_behind(
        hull(result[i - 1], inputs(i, result[i], before, sizes[i].height, edges)), before, edges.y);
  }
  return result;
}

HeldRows Network::convolved(std::size_t layer, std::size_t scale, const HeldRows& input, Rows rows,
                            std::int64_t own_height, Edges edges, bool relu) const {
  const std::int64_t lost = edges.y == Padding::valid ? radius(layer) : 0;
  std::vector<FeatureMaps> parts;
  for (const Branch& branch : branches(layer, scale)) {
    const std::int64_t r = branch.convolution.radius(), b = blur_radius(branch.blur);
    const Rows seen{rows.begin + lost - r, rows.end + lost + r};
    HeldRows from = input;
    if (b > 0) {
      from.rows = rows_behind(seen, input.height, edges.y);
      const at::Tensor sharp =
          take_rows(input, {from.rows.begin - b, from.rows.end + b}, of_blur(edges.y));
      from.data = blur(input.is_picture() ? sharp : to_planes({sharp, input.channels}), branch.blur,
                       of_blur(edges.x));
      if (!input.is_picture()) from.data = to_maps(from.data).data;
    }
    Edges beyond = edges;
    if (edges.y == Padding::valid || !from.whole() || rows != Rows{0, own_height}) {
      from.data = take_rows(from, seen, edges.y);
      beyond.y = Padding::valid;
    }
    parts.push_back(input.is_picture() ? branch.convolution(from.data, beyond, relu)
                                       : branch.convolution(from.maps(), beyond, relu));
  }
  crop_to_narrowest(parts);
  const FeatureMaps maps = parts.size() == 1 ? parts[0] : concatenate(parts);
  return {maps.data, maps.channels, rows, own_height};
}

HeldRows Network::pooled(std::size_t layer, const HeldRows& input, Rows rows,
                         std::int64_t own_height, Edges edges) const {
  const bool average =
      pooling_ == Pooling::average ||
      (pooling_ == Pooling::as_described && is<AveragePoolLayer>(description_.layers[layer]));
  std::vector<at::Tensor> parts;
  for (const auto& turn : turns(rows, input.height, own_height))
    parts.push_back(pool({take_rows(input, turn, edges.y), input.channels},
                         average ? PoolKind::average : PoolKind::max)
                        .data);
  return {parts.size() == 1 ? parts[0] : at::cat(parts, 1), input.channels, rows, own_height};
}

HeldRows Network::apply(std::size_t layer, std::size_t scale, const HeldRows& input, Rows rows,
                        std::int64_t own_height, Edges edges, bool relu) const {
  if (!branches_[layer].empty())
    return convolved(layer, scale, input, rows, own_height, edges, relu);
  HeldRows from = input;
  if (input.is_picture()) from.data = to_maps(input.data).data;
  if (is<ReluLayer>(description_.layers[layer]))
    return {at::relu(take_rows(from, rows, edges.y)), from.channels, rows, own_height};
  return pooled(layer, from, rows, own_height, edges);
}

Rows Network::rows_of_scale(Size scale, Edges edges, const std::vector<std::size_t>& wanted,
                            const std::vector<Rows>& rows) const {
  const auto sizes = this->sizes(scale, edges);
  return inputs(0, needed(sizes, edges, wanted, rows)[0], scale.height, sizes[0].height, edges);
}

std::vector<HeldRows> Network::maps_of_rows(std::size_t index, const HeldRows& scale, Edges edges,
                                            const std::vector<std::size_t>& wanted,
                                            const std::vector<Rows>& rows) const {
  const auto sizes = this->sizes(scale.size(), edges);
  const auto needed = this->needed(sizes, edges, wanted, rows);
  std::vector<HeldRows> result;
  HeldRows maps = scale;
  for (std::size_t i = 0; result.size() < wanted.size(); ++i) {
    const bool fuse = !branches_[i].empty() && wanted[result.size()] != i &&
                      i + 1 < description_.layers.size() &&
                      is<ReluLayer>(description_.layers[i + 1]);
    maps = apply(i, index, maps, needed[i], sizes[i].height, edges, fuse);
    if (fuse) ++i;
    if (wanted[result.size()] != i) continue;
    const Rows own = rows[result.size()];
    result.push_back({take_rows(maps, own, edges.y), maps.channels, own, maps.height});
  }
  return result;
}

std::vector<Scales> Network::operator()(const at::Tensor& picture, Edges edges,
                                        const std::vector<std::size_t>& wanted) const {
  std::vector<Scales> result(wanted.size());
  const auto scales = this->scales(picture, edges);
  for (std::size_t k = 0; k < scales.size(); ++k) {
    const auto sizes = this->sizes(size_of(scales[k]), edges);
    std::vector<Rows> all;
    for (const std::size_t layer : wanted) all.push_back({0, sizes[layer].height});
    const auto maps = this->maps_of_rows(k, all_rows(scales[k]), edges, wanted, all);
    for (std::size_t i = 0; i < wanted.size(); ++i) result[i].push_back(maps[i].maps());
  }
  return result;
}

Network Network::rescaled(const NetworkDescription& description,
                          const std::vector<FilterShape>& shapes,
                          std::vector<FilterWeights> weights, Pooling pooling,
                          const at::Tensor& picture, Edges edges) {
  const c10::NoGradGuard no_gradients;
  const Network network(description, shapes, weights, pooling);
  std::vector<HeldRows> maps;
  std::vector<std::vector<Size>> sizes;
  for (const auto& scale : network.scales(picture, edges)) {
    maps.push_back(all_rows(scale));
    sizes.push_back(network.sizes(size_of(scale), edges));
  }
  for (std::size_t layer = 0, filters = 0; layer < description.layers.size(); ++layer) {
    for (std::size_t k = 0; k < maps.size(); ++k) {
      const std::int64_t height = sizes[k][layer].height;
      maps[k] = network.apply(layer, k, maps[k], {0, height}, height, edges, false);
    }
    // The next layer sees what this one would give with filters divided by their activations.
    const auto multiply = [&](const at::Tensor& factor, std::size_t branches) {
      for (std::int64_t from = 0; branches > 0; --branches, ++filters) {
        FilterWeights& own = weights[filters];
        const at::Tensor part = factor.narrow(0, from, own.weights.size(0));
        own.weights = own.weights * part.view({-1, 1, 1, 1});
        if (own.bias.defined()) own.bias = own.bias * part;
        from += part.size(0);
      }
    };
    const auto scaled = [](const HeldRows& held, const at::Tensor& factor) {
      HeldRows result = held;
      result.data = to_maps(to_planes(held.maps()) * factor.view({-1, 1, 1})).data;
      return result;
    };
    const std::size_t branches = network.branches_[layer].size();
    if (network.is_pyramid(layer)) {
      for (auto& held : maps) {
        const at::Tensor factor = inverse_activation({held});
        multiply(factor, 1);
        held = scaled(held, factor);
      }
    } else if (branches > 0) {
      const at::Tensor factor = inverse_activation(maps);
      multiply(factor, branches);
      for (auto& held : maps) held = scaled(held, factor);
    }
  }
  return {description, shapes, std::move(weights), pooling};
}

}  // namespace gramloom::neural
