#include "neural/resample.h"

#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <cmath>

#include "core/threads.h"

namespace gramloom::neural {

namespace {

enum class Kernel { cubic, triangle };

double kernel_value(Kernel kernel, double t) {
  t = std::abs(t);
  if (kernel == Kernel::triangle) return std::max(0.0, 1 - t);
  if (t < 1) return (1.5 * t - 2.5) * t * t + 1;
  if (t < 2) return ((-0.5 * t + 2.5) * t - 4) * t + 2;
  return 0;
}

// A sparse matrix along one axis: row i is the sum of weights times old positions.
struct Tap {
  std::int64_t position;
  double weight;
};
using Taps = std::vector<std::vector<Tap>>;

Taps make_taps(std::int64_t from, std::int64_t to, bool wraps, Kernel kernel) {
  Taps taps(static_cast<std::size_t>(to));
  const double ratio = static_cast<double>(from) / static_cast<double>(to);
  const double width = std::max(1.0, ratio), reach = (kernel == Kernel::cubic ? 2 : 1) * width;
  for (std::int64_t i = 0; i < to; ++i) {
    auto& row = taps[static_cast<std::size_t>(i)];
    const double centre = (static_cast<double>(i) + 0.5) * ratio - 0.5;
    double sum = 0;
    for (auto k = static_cast<std::int64_t>(std::ceil(centre - reach));
         k <= static_cast<std::int64_t>(std::floor(centre + reach)); ++k) {
      const double weight = kernel_value(kernel, (static_cast<double>(k) - centre) / width);
      if (weight == 0) continue;
      row.push_back(
          {wraps ? ((k % from) + from) % from : std::clamp<std::int64_t>(k, 0, from - 1), weight});
      sum += weight;
    }
    for (auto& tap : row) tap.weight /= sum;
  }
  return taps;
}

Taps transposed(const Taps& taps, std::int64_t from) {
  Taps result(static_cast<std::size_t>(from));
  for (std::size_t i = 0; i < taps.size(); ++i)
    for (const auto& tap : taps[i])
      result[static_cast<std::size_t>(tap.position)].push_back(
          {static_cast<std::int64_t>(i), tap.weight});
  return result;
}

// target[i] = Σ weight · source[position · stride + i] over the taps
template <class T>
void gather(T* target, const T* source, std::int64_t stride, std::int64_t count,
            const std::vector<Tap>& taps) {
  std::fill_n(target, count, T{0});
  for (const auto& tap : taps) {
    const T weight = static_cast<T>(tap.weight);
    const T* from = source + tap.position * stride;
    for (std::int64_t i = 0; i < count; ++i) target[i] += weight * from[i];
  }
}

// data: (planes, height, width, depth); the rows of `taps` along height, then along width.
at::Tensor apply_taps(const at::Tensor& data, const Taps& along_y, const Taps& along_x) {
  const std::int64_t planes = data.size(0), width = data.size(2), depth = data.size(3);
  const auto rows = static_cast<std::int64_t>(along_y.size());
  const auto columns = static_cast<std::int64_t>(along_x.size());
  at::Tensor result = at::empty({planes, rows, columns, depth}, data.options());
  AT_DISPATCH_FLOATING_TYPES(data.scalar_type(), "resample", [&] {
    const scalar_t* source = data.data_ptr<scalar_t>();
    scalar_t* target = result.data_ptr<scalar_t>();
    parallel_for(planes * rows, 8, [&](std::int64_t begin, std::int64_t end) {
      std::vector<scalar_t> line(static_cast<std::size_t>(width * depth));
      for (std::int64_t r = begin; r < end; ++r) {
        gather(line.data(), source + r / rows * data.stride(0), width * depth, width * depth,
               along_y[static_cast<std::size_t>(r % rows)]);
        for (std::int64_t x = 0; x < columns; ++x)
          gather(target + (r * columns + x) * depth, line.data(), depth, depth,
                 along_x[static_cast<std::size_t>(x)]);
      }
    });
  });
  return result;
}

struct ResampleFunction : torch::autograd::Function<ResampleFunction> {
  static Taps taps(const std::vector<std::int64_t>& s, std::size_t axis) {
    return make_taps(s[axis], s[axis + 2], s[axis + 4] != 0, static_cast<Kernel>(s[6]));
  }

  // s: height and width before, after, whether they wrap, kernel
  static at::Tensor forward(torch::autograd::AutogradContext* context, const at::Tensor& data,
                            std::vector<std::int64_t> s) {
    context->saved_data["s"] = s;
    return apply_taps(data, taps(s, 0), taps(s, 1));
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 torch::autograd::variable_list gradients) {
    const auto s = context->saved_data["s"].toIntVector();
    return {apply_taps(gradients[0].contiguous(), transposed(taps(s, 0), s[0]),
                       transposed(taps(s, 1), s[1])),
            at::Tensor()};
  }
};

at::Tensor resample_blocks(const at::Tensor& data, Size size, Tile tile, Kernel kernel) {
  if (data.size(1) == size.height && data.size(2) == size.width) return data.clone();
  return ResampleFunction::apply(
      data.contiguous(),
      std::vector<std::int64_t>{data.size(1), data.size(2), size.height, size.width, tiles_y(tile),
                                tiles_x(tile), static_cast<std::int64_t>(kernel)});
}

}  // namespace

at::Tensor resample(const at::Tensor& planes, Size size, Tile tile) {
  return resample_blocks(planes.unsqueeze(3), size, tile, Kernel::cubic).squeeze(3);
}

FeatureMaps shrink(const FeatureMaps& maps, Size size, Tile tile) {
  return {resample_blocks(maps.data, size, tile, Kernel::triangle), maps.channels};
}

}  // namespace gramloom::neural
