#pragma once

#include <ATen/ATen.h>

#include "core/image.h"
#include "neural/params.h"

namespace gramloom::neural {

/// Feature maps of one picture, in blocks of channels as oneDNN's convolutions want them:
/// `data` is contiguous, (blocks, height, width, block), and channel c of position (y, x) is
/// data[c / block][y][x][c % block]. Channels beyond `channels` are zero. Everything that acts on
/// each channel alone (ReLU, pooling, padding) works on blocks as it would on maps.
struct FeatureMaps {
  at::Tensor data;
  std::int64_t channels = 0;

  std::int64_t height() const { return data.size(1); }
  std::int64_t width() const { return data.size(2); }
};

/// The maps of one layer at every scale of the network, finest first: one, but for pyramids.
using Scales = std::vector<FeatureMaps>;

/// Channels in a block: 16 where the processor has AVX-512, else 8.
std::int64_t channel_block();

/// Of (channels, height, width).
inline Size size_of(const at::Tensor& planes) {
  return {static_cast<int>(planes.size(2)), static_cast<int>(planes.size(1))};
}

/// planes: (channels, height, width).
FeatureMaps to_maps(const at::Tensor& planes);
/// (channels, height, width).
at::Tensor to_planes(const FeatureMaps& maps);
/// (height·width, channels): a row for each position.
at::Tensor to_rows(const FeatureMaps& maps);
/// The maps of all `parts`, one after the other; all of one height and width.
FeatureMaps concatenate(const std::vector<FeatureMaps>& parts);

/// What lies beyond the edges on each axis.
struct Edges {
  Padding x = Padding::circular;
  Padding y = Padding::circular;
};

/// The axes on which maps go on across the edge.
inline Tile wrapped_axes(Edges edges) {
  return wrapping(edges.x == Padding::circular, edges.y == Padding::circular);
}

/// Which of an axis' positions is seen at `position`, which may lie beyond its edges; −1: none.
std::int64_t source_of(std::int64_t position, std::int64_t length, Padding padding);

/// `maps` with `radius` more positions on every side; on axes of Padding::valid, unchanged.
/// A circular axis may be shorter than the radius; a reflecting one (which repeats the edge
/// position, so it may also be of any length) too.
FeatureMaps pad(const FeatureMaps& maps, std::int64_t radius, Edges edges);
/// The same for (channels, height, width).
at::Tensor pad_planes(const at::Tensor& planes, std::int64_t radius, Edges edges);

enum class PoolKind { average, max };
/// 2×2 with stride 2 (an odd last row or column is left out, as Gatys et al. and VGG do).
FeatureMaps pool(const FeatureMaps& maps, PoolKind kind);

}  // namespace gramloom::neural
