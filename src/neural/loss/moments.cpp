#include "neural/loss/moments.h"

#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <cstdlib>

#include "neural/resample.h"

namespace gramloom::neural {

namespace {

constexpr std::int64_t positions_at_once = 1 << 15;

// Calls f(first row, rows) for rows of a few ten thousand positions: a copy of all maps in rows
// would be as large as the maps.
template <class F>
void for_a_few_rows(const at::Tensor& data, F&& f) {
  const std::int64_t height = data.size(1);
  const std::int64_t rows = std::max<std::int64_t>(1, positions_at_once / data.size(2));
  for (std::int64_t y = 0; y < height; y += rows) f(y, std::min(rows, height - y));
}

at::Tensor rows_of(const at::Tensor& data, std::int64_t channels, std::int64_t y,
                   std::int64_t count) {
  return to_rows({data.narrow(1, y, count), channels}).contiguous();
}

// Keeps the maps, which the network keeps anyway, and nothing else.
struct MomentsFunction : torch::autograd::Function<MomentsFunction> {
  static torch::autograd::variable_list forward(torch::autograd::AutogradContext* context,
                                                const at::Tensor& data, std::int64_t channels,
                                                double positions) {
    context->save_for_backward({data});
    context->saved_data["channels"] = channels;
    context->saved_data["positions"] = positions;
    at::Tensor gram = at::zeros({channels, channels}, data.options());
    at::Tensor mean = at::zeros({channels}, data.options());
    for_a_few_rows(data, [&](std::int64_t y, std::int64_t count) {
      const at::Tensor rows = rows_of(data, channels, y, count);
      gram.addmm_(rows.t(), rows);
      mean.add_(rows.sum(0));
    });
    return {gram.div_(positions), mean.div_(positions)};
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 torch::autograd::variable_list gradients) {
    const at::Tensor data = context->get_saved_variables()[0];
    const auto channels = context->saved_data["channels"].toInt();
    const std::int64_t blocks = data.size(0), width = data.size(2), block = data.size(3);
    const double positions = context->saved_data["positions"].toDouble();
    const at::Tensor of_gram = gradients[0] + gradients[0].t();
    at::Tensor result = at::empty_like(data);
    for_a_few_rows(data, [&](std::int64_t y, std::int64_t count) {
      const at::Tensor of_rows = at::addmm(gradients[1], rows_of(data, channels, y, count), of_gram,
                                           1 / positions, 1 / positions);
      // Back into blocks: the transpose of to_rows().
      result.narrow(1, y, count)
          .copy_(at::constant_pad_nd(of_rows, {0, blocks * block - channels})
                     .view({count, width, blocks, block})
                     .permute({2, 0, 1, 3}));
    });
    return {result, {}, {}};
  }
};

}  // namespace

Moments moments(const FeatureMaps& maps) { return moments({maps}, Tile::none); }

namespace {

double positions(std::int64_t height, std::int64_t width) {
  return static_cast<double>(height) * static_cast<double>(width);
}

FeatureMaps rows_of(const HeldRows& maps, Rows rows) {
  return {take_rows(maps, rows, Padding::circular), maps.channels};
}

// Products of rows `own` of maps with the same maps shifted by (dy, dx) positions, dy ≥ 0.
at::Tensor shifted_products(const HeldRows& maps, Rows own, std::int64_t dy, std::int64_t dx,
                            Tile tile) {
  std::int64_t height = maps.height, width = maps.data.size(2), first = 0;
  if (!tiles_y(tile)) {
    height -= dy;
    own.end = std::min(own.end, height);
  }
  if (!tiles_x(tile)) {
    width -= std::abs(dx);
    first = std::max<std::int64_t>(-dx, 0);
  }
  if (own.empty()) return at::zeros({maps.channels, maps.channels}, maps.data.options());
  const auto matrix = [&](at::Tensor data) {
    return to_rows({data.narrow(2, first, width), maps.channels});
  };
  const at::Tensor there = rows_of(maps, {own.begin + dy, own.end + dy}).data;
  return at::mm(matrix(rows_of(maps, own).data).t(), matrix(at::roll(there, {-dx}, {2}))) /
         positions(height, width);
}

bool has_shift(Size size, int d) { return std::min(size.height, size.width) >= 2 * d; }

void add_shifted(const HeldRows& maps, Rows own, std::int64_t first, Tile tile,
                 const std::vector<int>& shifts, std::vector<Moments::Shifted>& shifted) {
  for (const int d : shifts) {
    if (!has_shift(maps.size(), d)) continue;
    for (const auto& [dy, dx] : {std::pair{0, d}, {d, 0}, {d, d}, {d, -d}})
      shifted.push_back({first, dy, dx, shifted_products(maps, own, dy, dx, tile)});
  }
}

Moments own_moments(const HeldRows& maps, Rows own) {
  auto result = MomentsFunction::apply(rows_of(maps, own).data, maps.channels,
                                       positions(maps.height, maps.data.size(2)));
  return {result[0], result[1], {}};
}

}  // namespace

std::vector<Rows> rows_for_moments(const std::vector<Size>& sizes, const std::vector<Rows>& own,
                                   Tile tile, const std::vector<int>& shifts) {
  std::vector<Rows> result = own;
  for (std::size_t k = sizes.size(); k-- > 0;) {
    for (const int d : shifts)
      if (has_shift(sizes[k], d)) result[k].end = std::max(result[k].end, own[k].end + d);
    if (k + 1 < sizes.size())
      result[k] = hull(result[k],
                       rows_to_shrink(result[k + 1], sizes[k].height, sizes[k + 1].height, tile));
    result[k] =
        rows_behind(result[k], sizes[k].height, tiles_y(tile) ? Padding::circular : Padding::valid);
  }
  return result;
}

Moments moments(const std::vector<HeldRows>& scales, const std::vector<Rows>& own, Tile tile,
                const std::vector<int>& shifts) {
  std::vector<Moments::Shifted> shifted;
  std::vector<HeldRows> finer;  // maps of finer scales, averaged to the present one's positions
  std::vector<at::Tensor> means;
  std::vector<std::vector<at::Tensor>> blocks(scales.size());  // of the Gram matrix
  std::int64_t channels = 0;
  for (std::size_t k = 0; k < scales.size(); ++k) {
    const HeldRows& scale = scales[k];
    add_shifted(scale, own[k], channels, tile, shifts, shifted);
    channels += scale.channels;
    const Moments alone = own_moments(scale, own[k]);
    means.push_back(alone.mean);
    for (std::size_t j = 0; j < finer.size(); ++j) {
      const Size size = scale.size();
      finer[j] = shrink(finer[j], size, scale.rows, tile);
      const at::Tensor cross =
          at::mm(to_rows(rows_of(scale, own[k])).t(), to_rows(rows_of(finer[j], own[k]))) /
          positions(size.height, size.width);
      blocks[k].push_back(cross);
      blocks[j].push_back(cross.t());
    }
    blocks[k].push_back(alone.gram);
    finer.push_back(scale);
  }
  std::vector<at::Tensor> rows;
  for (const auto& row : blocks) rows.push_back(at::cat(row, 1));
  return {at::cat(rows), at::cat(means), std::move(shifted)};
}

Moments moments(const Scales& scales, Tile tile, const std::vector<int>& shifts) {
  std::vector<HeldRows> all;
  std::vector<Rows> own;
  for (const auto& maps : scales) {
    own.push_back({0, maps.height()});
    all.push_back({maps.data, maps.channels, own.back(), maps.height()});
  }
  return moments(all, own, tile, shifts);
}

}  // namespace gramloom::neural
