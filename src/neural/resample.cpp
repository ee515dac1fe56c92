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

// Positions `rows` along an axis of `to`, from positions `held` of `from`.
struct Axis {
  std::int64_t from, to;
  bool wraps;
  Rows held, rows;
  static constexpr std::size_t numbers = 7;
};

Axis whole_axis(std::int64_t from, std::int64_t to, bool wraps) {
  return {from, to, wraps, {0, from}, {0, to}};
}

double reach_of(std::int64_t from, std::int64_t to, Kernel kernel) {
  const double width = std::max(1.0, static_cast<double>(from) / static_cast<double>(to));
  return (kernel == Kernel::cubic ? 2 : 1) * width;
}

double centre_of(std::int64_t position, std::int64_t from, std::int64_t to) {
  return (static_cast<double>(position) + 0.5) * static_cast<double>(from) /
             static_cast<double>(to) -
         0.5;
}

Taps make_taps(const Axis& axis, Kernel kernel) {
  Taps taps;
  const double reach = reach_of(axis.from, axis.to, kernel);
  const double width = reach / reach_of(1, 1, kernel);
  for (std::int64_t i = axis.rows.begin; i < axis.rows.end; ++i) {
    std::vector<Tap> row;
    // Beyond the edges of what wraps there are the same weights again, bit for bit.
    const std::int64_t turn = axis.wraps ? floor_divided(i, axis.to) : 0;
    const double centre = centre_of(i - turn * axis.to, axis.from, axis.to);
    double sum = 0;
    for (auto k = static_cast<std::int64_t>(std::ceil(centre - reach));
         k <= static_cast<std::int64_t>(std::floor(centre + reach)); ++k) {
      const double weight = kernel_value(kernel, (static_cast<double>(k) - centre) / width);
      if (weight == 0) continue;
      row.push_back({axis.wraps ? held_copy(k + turn * axis.from, axis.held, axis.from)
                                : std::clamp<std::int64_t>(k, 0, axis.from - 1) - axis.held.begin,
                     weight});
      sum += weight;
    }
    for (auto& tap : row) tap.weight /= sum;
    taps.push_back(std::move(row));
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

// Along an axis as numbers that an autograd context can keep.
std::vector<std::int64_t> numbers_of(const Axis& y, const Axis& x, Kernel kernel) {
  std::vector<std::int64_t> result;
  for (const Axis& a : {y, x})
    result.insert(result.end(),
                  {a.from, a.to, a.wraps, a.held.begin, a.held.end, a.rows.begin, a.rows.end});
  result.push_back(static_cast<std::int64_t>(kernel));
  return result;
}
Taps taps_of(const std::vector<std::int64_t>& n, std::size_t axis) {
  const auto a = n.begin() + static_cast<std::ptrdiff_t>(axis * Axis::numbers);
  return make_taps({a[0], a[1], a[2] != 0, {a[3], a[4]}, {a[5], a[6]}},
                   static_cast<Kernel>(n.back()));
}

struct ResampleFunction : torch::autograd::Function<ResampleFunction> {
  static at::Tensor forward(torch::autograd::AutogradContext* context, const at::Tensor& data,
                            std::vector<std::int64_t> axes) {
    context->saved_data["axes"] = axes;
    context->saved_data["shape"] = data.sizes().vec();
    return apply_taps(data, taps_of(axes, 0), taps_of(axes, 1));
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 torch::autograd::variable_list gradients) {
    const auto axes = context->saved_data["axes"].toIntVector();
    const auto shape = context->saved_data["shape"].toIntVector();
    return {apply_taps(gradients[0].contiguous(), transposed(taps_of(axes, 0), shape[1]),
                       transposed(taps_of(axes, 1), shape[2])),
            at::Tensor()};
  }
};

}  // namespace

at::Tensor resample(const at::Tensor& planes, Size size, Tile tile) {
  if (size_of(planes) == size) return planes.clone();
  return resample(all_rows(planes), size, {0, size.height}, tile).data;
}

HeldRows resample(const HeldRows& picture, Size size, Rows rows, Tile tile) {
  const Axis y{picture.height, size.height, tiles_y(tile), picture.rows, rows};
  const Axis x = whole_axis(picture.data.size(2), size.width, tiles_x(tile));
  const at::Tensor data = ResampleFunction::apply(picture.data.unsqueeze(3).contiguous(),
                                                  numbers_of(y, x, Kernel::cubic));
  return {data.squeeze(3), picture.channels, rows, size.height};
}

namespace {

Rows rows_behind_kernel(Rows rows, std::int64_t height, std::int64_t own_height, Tile tile,
                        Kernel kernel) {
  const double reach = reach_of(height, own_height, kernel);
  const auto first = std::ceil(centre_of(rows.begin, height, own_height) - reach);
  const auto last = std::floor(centre_of(rows.end - 1, height, own_height) + reach);
  return rows_behind({static_cast<std::int64_t>(first), static_cast<std::int64_t>(last) + 1},
                     height, tiles_y(tile) ? Padding::circular : Padding::valid);
}

}  // namespace

Rows rows_to_resample(Rows rows, std::int64_t height, std::int64_t own_height, Tile tile) {
  return rows_behind_kernel(rows, height, own_height, tile, Kernel::cubic);
}

Rows rows_to_shrink(Rows rows, std::int64_t height, std::int64_t own_height, Tile tile) {
  return rows_behind_kernel(rows, height, own_height, tile, Kernel::triangle);
}

HeldRows shrink(const HeldRows& maps, Size size, Rows rows, Tile tile) {
  const Axis y{maps.height, size.height, tiles_y(tile), maps.rows, rows};
  const Axis x = whole_axis(maps.data.size(2), size.width, tiles_x(tile));
  return {ResampleFunction::apply(maps.data.contiguous(), numbers_of(y, x, Kernel::triangle)),
          maps.channels, rows, size.height};
}

}  // namespace gramloom::neural
