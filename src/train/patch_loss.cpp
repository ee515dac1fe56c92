#include "train/patch_loss.h"

#include <algorithm>

#include "core/threads.h"
#include "signal/sort.h"
#include "train/networks.h"

namespace gramloom::train {

namespace {

// Unit vectors, as filters.
at::Tensor random_filters(int count, std::int64_t channels, int side, at::ScalarType type) {
  const at::Tensor filters = torch::randn({count, channels, side, side});
  const at::Tensor length = filters.flatten(1).norm(2, 1).view({count, 1, 1, 1});
  return (filters / length).to(type).contiguous(at::MemoryFormat::ChannelsLast);
}

// (batch, directions, height, width) as a row a direction.
at::Tensor as_rows(const at::Tensor& projections) {
  return projections.permute({1, 0, 2, 3}).reshape({projections.size(1), -1});
}

// The exemplar's projections; `sparse`: of every other patch, from a random one on.
at::Tensor projections_of(const at::Tensor& exemplar, const at::Tensor& filters, bool sparse) {
  if (!sparse) return at::conv2d(exemplar, filters);
  const at::Tensor first = at::randint(2, {2}, at::kLong);
  return at::conv2d(
      exemplar.slice(2, first[0].item<std::int64_t>()).slice(3, first[1].item<std::int64_t>()),
      filters, {}, 2);
}

}  // namespace

at::Tensor of_same_rank(const at::Tensor& values, const at::Tensor& target) {
  const at::Tensor from = values.to(at::kFloat).contiguous();
  at::Tensor sorted = target.to(at::kFloat).contiguous().clone();
  at::Tensor result = at::empty_like(from);
  const std::int64_t rows = from.size(0), n = from.size(1), m = sorted.size(1);
  const float* first = from.data_ptr<float>();
  float* ranked_target = sorted.data_ptr<float>();
  float* to = result.data_ptr<float>();
  parallel_for(rows, 1, [&](std::int64_t begin, std::int64_t end) {
    Sorter sorter;
    for (std::int64_t r = begin; r < end; ++r) {
      float* goal = ranked_target + r * m;
      sorter.sort({goal, static_cast<std::size_t>(m)});
      const auto ranked = sorter.rank({first + r * n, static_cast<std::size_t>(n)});
      for (std::int64_t i = 0; i < n; ++i) {
        const double place =
            (static_cast<double>(i) + 0.5) * static_cast<double>(m) / static_cast<double>(n) - 0.5;
        const double inside = std::clamp(place, 0.0, static_cast<double>(m - 1));
        const auto below = static_cast<std::int64_t>(inside);
        const std::int64_t above = std::min(below + 1, m - 1);
        const auto share = static_cast<float>(inside - static_cast<double>(below));
        to[r * n + ranked[static_cast<std::size_t>(i)].place] =
            goal[below] + share * (goal[above] - goal[below]);
      }
    }
  });
  return result.to(values.scalar_type());
}

at::Tensor sliced_distance(const at::Tensor& pictures, const at::Tensor& exemplar, int directions,
                           int patch_size, bool wraps) {
  const at::Tensor filters =
      random_filters(directions, pictures.size(1), patch_size, pictures.scalar_type());
  const at::Tensor around = wraps ? padded(pictures, patch_size / 2, Border::wraps) : pictures;
  const at::Tensor projections = at::conv2d(around, filters);
  at::Tensor goal;
  {
    const torch::NoGradGuard no_gradients;
    const at::Tensor matched = of_same_rank(
        as_rows(projections.detach()),
        as_rows(projections_of(exemplar, filters, exemplar.size(2) > pictures.size(2))));
    goal = matched.view({directions, projections.size(0), projections.size(2), projections.size(3)})
               .permute({1, 0, 2, 3});
  }
  return (projections - goal).square().mean();
}

}  // namespace gramloom::train
