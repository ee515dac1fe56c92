#include "neural/network/feature_maps.h"

#include <torch/csrc/autograd/custom_function.h>

#include "core/threads.h"
#include "signal/onednn.h"

namespace gramloom::neural {

namespace {

// Where each position of a padded axis comes from; −1: from nowhere.
std::vector<std::int64_t> sources(std::int64_t length, std::int64_t radius, Padding padding) {
  if (padding == Padding::valid) radius = 0;
  std::vector<std::int64_t> from(static_cast<std::size_t>(length + 2 * radius));
  for (std::size_t i = 0; i < from.size(); ++i)
    from[i] = source_of(static_cast<std::int64_t>(i) - radius, length, padding);
  return from;
}

// Padding of (planes, height, width, depth), contiguous. The gradient of a copied value is the sum
// over its copies.
struct PadFunction : torch::autograd::Function<PadFunction> {
  static at::Tensor forward(torch::autograd::AutogradContext* context, const at::Tensor& input,
                            std::int64_t radius, std::int64_t edges_x, std::int64_t edges_y) {
    context->saved_data["shape"] = input.sizes().vec();
    context->saved_data["radius"] = radius;
    context->saved_data["x"] = edges_x;
    context->saved_data["y"] = edges_y;
    const auto from_y = sources(input.size(1), radius, static_cast<Padding>(edges_y));
    const auto from_x = sources(input.size(2), radius, static_cast<Padding>(edges_x));
    const auto rows = static_cast<std::int64_t>(from_y.size());
    const auto columns = static_cast<std::int64_t>(from_x.size());
    at::Tensor output = at::empty({input.size(0), rows, columns, input.size(3)}, input.options());
    AT_DISPATCH_FLOATING_TYPES(input.scalar_type(), "pad", [&] {
      const scalar_t* source = input.data_ptr<scalar_t>();
      scalar_t* target = output.data_ptr<scalar_t>();
      const std::int64_t depth = input.size(3), row = input.size(2) * depth;
      parallel_for(input.size(0) * rows, 16, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t line = begin; line < end; ++line) {
          const std::int64_t y = from_y[static_cast<std::size_t>(line % rows)];
          scalar_t* out = target + line * columns * depth;
          if (y < 0) {
            std::fill_n(out, columns * depth, scalar_t{0});
            continue;
          }
          const scalar_t* in = source + (line / rows * input.size(1) + y) * row;
          for (const std::int64_t x : from_x) {
            if (x < 0)
              std::fill_n(out, depth, scalar_t{0});
            else
              std::copy_n(in + x * depth, depth, out);
            out += depth;
          }
        }
      });
    });
    return output;
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 torch::autograd::variable_list gradients) {
    const auto shape = context->saved_data["shape"].toIntVector();
    const auto radius = context->saved_data["radius"].toInt();
    const auto from_y =
        sources(shape[1], radius, static_cast<Padding>(context->saved_data["y"].toInt()));
    const auto from_x =
        sources(shape[2], radius, static_cast<Padding>(context->saved_data["x"].toInt()));
    const auto rows = static_cast<std::int64_t>(from_y.size());
    const auto columns = static_cast<std::int64_t>(from_x.size());
    const at::Tensor upstream = gradients[0].contiguous();
    at::Tensor result = at::zeros(shape, upstream.options());
    AT_DISPATCH_FLOATING_TYPES(upstream.scalar_type(), "pad_backward", [&] {
      const scalar_t* source = upstream.data_ptr<scalar_t>();
      scalar_t* target = result.data_ptr<scalar_t>();
      const std::int64_t depth = shape[3];
      parallel_for(shape[0], 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t line = begin * rows; line < end * rows; ++line) {
          const std::int64_t y = from_y[static_cast<std::size_t>(line % rows)];
          if (y < 0) continue;
          scalar_t* out = target + (line / rows * shape[1] + y) * shape[2] * depth;
          const scalar_t* in = source + line * columns * depth;
          for (std::int64_t i = 0; i < columns; ++i, in += depth) {
            const std::int64_t x = from_x[static_cast<std::size_t>(i)];
            if (x < 0) continue;
            for (std::int64_t c = 0; c < depth; ++c) out[x * depth + c] += in[c];
          }
        }
      });
    });
    return {result, {}, {}, {}};
  }
};

at::Tensor pad_blocks(const at::Tensor& data, std::int64_t radius, Edges edges) {
  if (radius == 0 || (edges.x == Padding::valid && edges.y == Padding::valid)) return data;
  return PadFunction::apply(data.contiguous(), radius, static_cast<std::int64_t>(edges.x),
                            static_cast<std::int64_t>(edges.y));
}

}  // namespace

std::int64_t source_of(std::int64_t position, std::int64_t length, Padding padding) {
  const auto modulo = [position](std::int64_t period) {
    return ((position % period) + period) % period;
  };
  if (padding == Padding::circular) return modulo(length);
  if (padding == Padding::reflect)  // … 1 0 | 0 1 2 … length−1 | length−1 length−2 …
    return std::min(modulo(2 * length), 2 * length - 1 - modulo(2 * length));
  return position >= 0 && position < length ? position : -1;
}

std::int64_t channel_block() { return gramloom::channel_block(); }

FeatureMaps to_maps(const at::Tensor& planes) {
  const std::int64_t block = channel_block();
  const std::int64_t channels = planes.size(0), blocks = (channels + block - 1) / block;
  at::Tensor padded = planes;
  if (blocks * block != channels)
    padded = at::constant_pad_nd(planes, {0, 0, 0, 0, 0, blocks * block - channels});
  return {padded.reshape({blocks, block, planes.size(1), planes.size(2)})
              .permute({0, 2, 3, 1})
              .contiguous(),
          channels};
}

at::Tensor to_planes(const FeatureMaps& maps) {
  return maps.data.permute({0, 3, 1, 2})
      .reshape({-1, maps.height(), maps.width()})
      .narrow(0, 0, maps.channels)
      .contiguous();
}

at::Tensor to_rows(const FeatureMaps& maps) {
  return maps.data.permute({1, 2, 0, 3})
      .reshape({maps.height() * maps.width(), -1})
      .narrow(1, 0, maps.channels);
}

FeatureMaps concatenate(const std::vector<FeatureMaps>& parts) {
  std::vector<at::Tensor> tensors;
  std::int64_t channels = 0;
  bool whole_blocks = true;  // all but the last part fill their blocks
  for (const auto& part : parts) {
    whole_blocks = whole_blocks && channels % channel_block() == 0;
    channels += part.channels;
  }
  for (const auto& part : parts) tensors.push_back(whole_blocks ? part.data : to_planes(part));
  if (whole_blocks) return {at::cat(tensors), channels};
  return to_maps(at::cat(tensors));
}

FeatureMaps pad(const FeatureMaps& maps, std::int64_t radius, Edges edges) {
  return {pad_blocks(maps.data, radius, edges), maps.channels};
}

at::Tensor pad_planes(const at::Tensor& planes, std::int64_t radius, Edges edges) {
  return pad_blocks(planes.unsqueeze(3), radius, edges).squeeze(3);
}

FeatureMaps pool(const FeatureMaps& maps, PoolKind kind) {
  const at::Tensor images = maps.data.permute({0, 3, 1, 2});  // channels-last, blocks as a batch
  const at::Tensor pooled = kind == PoolKind::max ? at::max_pool2d(images, {2, 2}, {2, 2})
                                                  : at::avg_pool2d(images, {2, 2}, {2, 2});
  return {pooled.permute({0, 2, 3, 1}).contiguous(), maps.channels};
}

}  // namespace gramloom::neural
