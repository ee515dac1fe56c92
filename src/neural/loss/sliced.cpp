#include "neural/loss/sliced.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/threads.h"
#include "neural/loss/patches.h"
#include "neural/loss/wasserstein.h"
#include "neural/network/feature_maps.h"

namespace gramloom::neural {

namespace {

void check_fit(const char* what, Size size, Tile wraps, int side) {
  if ((tiles_y(wraps) || size.height >= side) && (tiles_x(wraps) || size.width >= side)) return;
  throw Error("the {0} of {1}×{2} is too small for patches of {3}×{3}: make patch_sizes smaller",
              what, size.width, size.height, side);
}

// Calls f(some of the filters), few enough for that many positions.
template <class F>
void for_each_group(const at::Tensor& filters, std::int64_t positions, F&& f) {
  const std::int64_t at_once =
      std::max(least_directions_at_once, sliced_values_at_once / positions);
  for (std::int64_t first = 0; first < filters.size(0); first += at_once)
    f(filters.narrow(0, first, std::min(at_once, filters.size(0) - first)));
}

}  // namespace

void check_patches_fit(const std::vector<int>& patch_sizes, Size exemplar, Size target,
                       Tile wraps) {
  for (const int side : patch_sizes) {
    check_fit("exemplar", exemplar, Tile::none, side);
    check_fit("texture", target, wraps, side);
  }
}

SlicedTerm::SlicedTerm(at::Tensor exemplar, Size target, Tile wraps, std::vector<int> patch_sizes,
                       int directions, Random random)
    : exemplar_(std::move(exemplar)),
      wraps_(wraps),
      patch_sizes_(std::move(patch_sizes)),
      directions_(directions),
      random_(random) {
  check_patches_fit(patch_sizes_, size_of(exemplar_), target, wraps);
  for_each_group(filters(0), exemplar_.numel() / exemplar_.size(0), [&](const at::Tensor& some) {
    flat_ += distance_from_mean(project_patches(exemplar_, some, Tile::none));
  });
  flat_ /= directions_;
  // The mean of equal values is rounded.
  if (flat_ < 1e-6 * exemplar_.square().mean().sqrt().item<double>()) flat_ = 0;
}

at::Tensor SlicedTerm::filters(std::uint64_t step) const {
  const std::int64_t side = patch_sizes_[step % patch_sizes_.size()], channels = exemplar_.size(0);
  return random_directions(random_.stream(step), directions_, channels * side * side)
      .view({directions_, channels, side, side});
}

double SlicedTerm::add(const at::Tensor& picture, double weight, std::uint64_t step,
                       at::Tensor& gradient) const {
  if (flat_ == 0) {  // a flat exemplar: its colour is all there is to match
    const at::Tensor off = picture - exemplar_.mean({1, 2}, true);
    gradient.add_(off, weight * 2 / static_cast<double>(picture.numel()));
    return off.square().mean().item<double>();
  }
  const std::int64_t positions = std::max(picture.numel(), exemplar_.numel()) / picture.size(0);
  double sum = 0;
  for_each_group(filters(step), positions, [&](const at::Tensor& some) {
    const auto count = static_cast<double>(some.size(0));
    at::Tensor goal = project_patches(exemplar_, some, Tile::none);
    sort_rows(goal);
    at::Tensor values = project_patches(picture, some, wraps_);
    sum += wasserstein(values, goal) * count;
    spread_patches(values.mul_(weight * count / directions_ / flat_), some, wraps_, gradient);
  });
  return sum / directions_ / flat_;
}

}  // namespace gramloom::neural
