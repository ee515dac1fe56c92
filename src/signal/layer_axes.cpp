#include "signal/layer_axes.h"

#include <cmath>

#include "core/threads.h"

namespace gramloom {

namespace {

// Below this share of an axis's variance, what is left of it is rounding.
constexpr double least_variance = 1e-6;

std::size_t index_of(int value) { return static_cast<std::size_t>(value); }

constexpr std::int64_t rows_of_a_sum = 16;

// Mean products of an image's channels, from `from` on, with all before and themselves. The order
// of the additions depends on the image alone.
std::vector<double> mean_products(const Image& image, int from) {
  const std::size_t n = index_of(image.channels);
  const auto chunks = static_cast<std::size_t>((image.height + rows_of_a_sum - 1) / rows_of_a_sum);
  std::vector<double> partial(chunks * n * n);
  parallel_for(image.height, rows_of_a_sum, [&](std::int64_t begin, std::int64_t end) {
    double* sums = partial.data() + static_cast<std::size_t>(begin / rows_of_a_sum) * n * n;
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < image.width; ++x) {
        const float* pixel = image.at(x, y);
        for (std::size_t i = index_of(from); i < n; ++i)
          for (std::size_t j = 0; j <= i; ++j)
            sums[i * n + j] += double{pixel[i]} * double{pixel[j]};
      }
  });
  std::vector<double> mean(n * n);
  const double pixels = 1.0 * image.width * image.height;
  for (std::size_t i = 0; i < partial.size(); ++i) mean[i % (n * n)] += partial[i] / pixels;
  return mean;
}

// Cholesky's factor of a matrix whose first rows, up to `from`, are those of the unit matrix.
std::vector<float> triangular_factor(const std::vector<double>& products, std::size_t n,
                                     std::size_t from) {
  std::vector<double> factor(n * n);
  for (std::size_t i = 0; i < from; ++i) factor[i * n + i] = 1;
  for (std::size_t i = from; i < n; ++i) {
    double left = products[i * n + i];
    for (std::size_t j = 0; j < i; ++j) {
      if (factor[j * n + j] == 0) continue;
      double share = products[i * n + j];
      for (std::size_t k = 0; k < j; ++k) share -= factor[i * n + k] * factor[j * n + k];
      factor[i * n + j] = share / factor[j * n + j];
      left -= factor[i * n + j] * factor[i * n + j];
    }
    if (left > least_variance) factor[i * n + i] = std::sqrt(left);
  }
  return {factor.begin(), factor.end()};
}

// Whether the axes of later blocks have shares of those before: else there is nothing to do.
bool has_shares(const LayerAxes& axes) { return !axes.shares.empty(); }

template <class Body>
void for_each_pixel(Image& image, const Body& body) {
  parallel_for(image.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < image.width; ++x) body(image.at(x, y));
  });
}

}  // namespace

std::vector<ChannelBlock> channel_blocks(const std::vector<Layer>& layers, int channels) {
  std::vector<ChannelBlock> blocks;
  for (const Layer& layer : layers) {
    const bool together = layer.kind == MapKind::colour || layer.kind == MapKind::normal;
    const int count = together ? layer.count : 1;
    for (int c = 0; c < layer.count; c += count) blocks.push_back({layer.first + c, count});
  }
  if (blocks.empty()) blocks.push_back({0, channels});
  return blocks;
}

ColourPca principal_axes(const Image& image, const std::vector<ChannelBlock>& blocks) {
  if (blocks.size() == 1) return colour_pca(image);
  const std::size_t n = index_of(image.channels);
  ColourPca all{image.channels, {}, std::vector<float>(n * n), {}};
  for (const ChannelBlock& block : blocks) {
    const ColourPca own = colour_pca(extract_channels(image, block.first, block.count));
    all.mean.insert(all.mean.end(), own.mean.begin(), own.mean.end());
    all.deviation.insert(all.deviation.end(), own.deviation.begin(), own.deviation.end());
    for (int axis = 0; axis < block.count; ++axis)
      for (int c = 0; c < block.count; ++c)
        all.axes[index_of(block.first + axis) * n + index_of(block.first + c)] =
            own.axes[index_of(axis * block.count + c)];
  }
  return all;
}

bool LayerAxes::is_flat(int axis) const {
  const std::size_t i = index_of(axis);
  return own.deviation[i] == 0 || (!shares.empty() && shares[i * own.mean.size() + i] == 0);
}

LayerAxes layer_axes(const Image& image, const std::vector<Layer>& layers) {
  const auto blocks = channel_blocks(layers, image.channels);
  LayerAxes axes{principal_axes(image, blocks), {}};
  if (blocks.size() > 1) {
    const Image white = whitened(image, axes.own);
    axes.shares = triangular_factor(mean_products(white, blocks.front().count),
                                    index_of(image.channels), index_of(blocks.front().count));
  }
  return axes;
}

Image whitened(const Image& image, const LayerAxes& axes) {
  Image result = whitened(image, axes.own);
  if (!has_shares(axes)) return result;
  const std::size_t n = index_of(image.channels);
  for_each_pixel(result, [&](float* pixel) {
    for (std::size_t i = 0; i < n; ++i) {
      const float* shares = axes.shares.data() + i * n;
      float left = pixel[i];
      for (std::size_t j = 0; j < i; ++j) left -= shares[j] * pixel[j];
      pixel[i] = shares[i] > 0 ? left / shares[i] : 0;
    }
  });
  return result;
}

Image unwhitened(const Image& image, const LayerAxes& axes) {
  if (!has_shares(axes)) return unwhitened(image, axes.own);
  Image white = image;
  const std::size_t n = index_of(image.channels);
  for_each_pixel(white, [&](float* pixel) {
    for (std::size_t i = n; i-- > 0;) {
      const float* shares = axes.shares.data() + i * n;
      float sum = 0;
      for (std::size_t j = 0; j <= i; ++j) sum += shares[j] * pixel[j];
      pixel[i] = sum;
    }
  });
  return unwhitened(white, axes.own);
}

}  // namespace gramloom
