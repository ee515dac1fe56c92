#include "neural/loss/sliced.h"

#include <span>

#include "core/threads.h"
#include "neural/loss/directed_sliced.h"
#include "neural/loss/loss_term.h"
#include "neural/loss/patch_sample.h"
#include "neural/loss/patch_slopes.h"
#include "neural/loss/patches.h"
#include "neural/loss/potential.h"
#include "neural/loss/wasserstein.h"

namespace gramloom::neural {

namespace {

std::int64_t pixels_of(const at::Tensor& picture) { return picture.size(1) * picture.size(2); }

// Calls f(`at_once` of the filters) for all of them.
template <class F>
void for_each_group(const at::Tensor& filters, std::int64_t at_once, F&& f) {
  for (std::int64_t first = 0; first < filters.size(0); first += at_once)
    f(filters.narrow(0, first, std::min(at_once, filters.size(0) - first)));
}

// Of each row; the values are those of all processes together, the goal is the same in each.
std::vector<Potential> potentials_of(const Group& group, const at::Tensor& values,
                                     const at::Tensor& goal) {
  const auto row = [](const at::Tensor& rows, std::int64_t r) {
    return std::span<const float>(rows.data_ptr<float>() + r * rows.size(1),
                                  static_cast<std::size_t>(rows.size(1)));
  };
  const std::int64_t count = values.size(0);
  const auto for_each_row = [&](auto&& f) {
    parallel_for(count, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t r = begin; r < end; ++r) f(r, static_cast<std::size_t>(r));
    });
  };
  const auto size = static_cast<std::size_t>(count);
  std::vector<float> lows(size), highs(size);  // of low, the negative
  for_each_row([&](std::int64_t r, std::size_t i) {
    const Potential::Range own = Potential::range_of(row(values, r)),
                           wanted = Potential::range_of(row(goal, r));
    lows[i] = -std::min(own.low, wanted.low);
    highs[i] = std::max(own.high, wanted.high);
  });
  group.largest(std::span(lows));
  group.largest(std::span(highs));
  const auto range = [&](std::size_t i) { return Potential::Range{-lows[i], highs[i]}; };
  std::vector<Potential::Counts> counts(size);
  for_each_row([&](std::int64_t r, std::size_t i) {
    if (highs[i] > -lows[i]) counts[i] = Potential::count(row(values, r), range(i));
  });
  group.sum(std::span(counts.front().data(), size * Potential::bins));
  std::vector<Potential> potentials(size);
  for_each_row([&](std::int64_t r, std::size_t i) {
    if (highs[i] > -lows[i])
      potentials[i] = Potential(range(i), counts[i], Potential::count(row(goal, r), range(i)));
  });
  return potentials;
}

// Rows of positions, and the picture in which their patches lie, from its first row on.
struct Part {
  std::int64_t begin, end;
  at::Tensor picture, gradient;
};

class SlicedTerm : public PictureTerm {
 public:
  SlicedTerm(const SlicedParams& params, const LossInput& input)
      : exemplar_(input.exemplar),
        wraps_(input.target.tile),
        size_(input.target.size),
        group_(input.group),
        patch_sizes_(params.patch_sizes),
        positions_(params.positions),
        directions_(input.directions),
        random_(input.random) {
    check_patches_fit(patch_sizes_, size_of(exemplar_), input.target.size, wraps_);
    for_each_group(filters(0), directions_at_once(pixels_of(exemplar_)),
                   [&](const at::Tensor& some) { flat_ += distance_from_mean(goal(some, 0)); });
    flat_ /= directions_;
    // The mean of equal values is rounded.
    if (flat_ < 1e-6 * exemplar_.square().mean().sqrt().item<double>()) flat_ = 0;
  }

  double add(const at::Tensor& picture, double weight, std::uint64_t step,
             at::Tensor& gradient) const override {
    if (flat_ == 0) {
      const at::Tensor off = picture - exemplar_.mean({1, 2}, true);
      const auto values = static_cast<double>(picture.size(0) * pixels());
      gradient.add_(off, weight * 2 / values);
      return sum_of(group_, off.square().sum().item<double>()) / values;
    }
    const std::int64_t at_once = directions_at_once(std::max(pixels(), pixels_of(exemplar_)));
    double sum = 0;
    for_each_group(filters(step), at_once, [&](const at::Tensor& some) {
      const double own = weight * static_cast<double>(some.size(0)) / directions_ / flat_;
      const bool all = positions(some.size(2)).count() <= positions_;
      const double distance = all ? add_all(picture, some, own, step, gradient)
                                  : add_sampled(picture, some, own, step, gradient);
      sum += distance * static_cast<double>(some.size(0));
    });
    return sum / directions_ / flat_;
  }

 private:
  std::int64_t pixels() const { return std::int64_t{size_.width} * size_.height; }
  // Of the whole picture.
  PatchPositions positions(std::int64_t side) const {
    return {exemplar_.size(0), size_, side, wraps_};
  }

  // Few enough for the values of all positions, or of a sample of them.
  std::int64_t directions_at_once(std::int64_t pixels) const {
    return pixels > positions_ ? sampled_directions_at_once
                               : std::max(least_directions_at_once, sliced_values_at_once / pixels);
  }

  // (directions, channels, side, side): unit vectors; step i has patch_sizes[i mod their number].
  at::Tensor filters(std::uint64_t step) const {
    const std::int64_t side = patch_sizes_[step % patch_sizes_.size()],
                       channels = exemplar_.size(0);
    return random_directions(random_.stream(step), directions_, channels * side * side)
        .view({directions_, channels, side, side});
  }

  // The exemplar's patches, all or of the step's sample.
  at::Tensor goal(const at::Tensor& filters, std::uint64_t step) const {
    const PatchPositions all(exemplar_, filters.size(2), Tile::none);
    if (all.count() <= positions_) return project_patches(exemplar_, filters, Tile::none);
    return project_sample(exemplar_, filters, Tile::none, sample_of(all, step));
  }
  PatchSample sample_of(const PatchPositions& all, std::uint64_t step) const {
    return {all, positions_, random_.stream(step).stream(0)};
  }

  // The mean distance along some directions; adds `weight` times its gradient.
  double add_all(const at::Tensor& picture, const at::Tensor& filters, double weight,
                 std::uint64_t step, at::Tensor& gradient) const {
    at::Tensor sorted = goal(filters, step);
    sort_rows(sorted);
    at::Tensor values = project_patches(picture, filters, wraps_);
    const double distance = wasserstein(values, sorted, weight);
    spread_patches(values, filters, wraps_, gradient);
    return distance;
  }

  // The same, the distance that of a sample of the positions, and the gradient at all positions
  // that of the sample's potential.
  double add_sampled(const at::Tensor& picture, const at::Tensor& filters, double weight,
                     std::uint64_t step, at::Tensor& gradient) const {
    const std::int64_t side = filters.size(2);
    const PatchPositions all = positions(side);
    const PatchSample sample = sample_of(all, step);
    // Patches of the last rows that a process has go on in the rows below: of these few rows it has
    // a copy with a gradient of its own, beside its picture.
    const Rows own = own_rows(group_, size_.height);
    const std::int64_t end = std::max(own.begin, std::min(own.end, all.rows));
    const std::int64_t inside =
        group_.alone() ? end : std::max(own.begin, std::min(own.end - side + 1, end));
    const Rows last{inside, inside < end ? end + side - 1 : inside};
    const RowExchange exchange(group_, size_.height, last);
    at::Tensor below, of_below;
    if (!group_.alone()) {
      below = exchange.take(held_by(group_, picture, size_.height)).data;
      of_below = at::zeros_like(below);
    }
    std::vector<Part> parts;
    if (own.begin < inside) parts.push_back({own.begin, inside, picture, gradient});
    if (inside < end) parts.push_back({inside, end, below, of_below});
    const Tile wraps = group_.alone() ? wraps_ : wrapping(tiles_x(wraps_), false);
    std::vector<at::Tensor> values;
    for (const Part& part : parts)
      values.push_back(
          project_sample(part.picture, filters, wraps, sample.in_rows(part.begin, part.end)));
    const auto potentials = potentials_of(
        group_, values.size() == 1 ? values[0] : at::cat(values, 1), goal(filters, step));
    const auto directions = static_cast<double>(filters.size(0));
    const auto slope = static_cast<float>(weight / static_cast<double>(all.count()) / directions);
    for (Part& part : parts)
      add_slopes(
          part.picture, filters, wraps,
          [&](std::int64_t filter, std::span<float> products) {
            potentials[static_cast<std::size_t>(filter)].to_slopes(products, slope);
          },
          part.gradient);
    if (!group_.alone()) exchange.add_back(of_below, gradient);
    double sum = 0;
    for (const Potential& potential : potentials) sum += potential.distance();
    return sum / directions;
  }

  at::Tensor exemplar_;
  Tile wraps_;  // the edges across which patches of the result go on; the exemplar's stay inside
  Size size_;   // of the result
  const Group& group_;
  std::vector<int> patch_sizes_;
  std::int64_t positions_;  // at most, whose patches are compared
  int directions_;
  Random random_;
  double flat_ = 0;  // the exemplar's distance from a flat picture; 0: it is flat itself
};

}  // namespace

std::unique_ptr<PictureTerm> make_term(const SlicedParams& params, const LossInput& input) {
  if (input.guidance) return make_directed_sliced(params, input);
  return std::make_unique<SlicedTerm>(params, input);
}

}  // namespace gramloom::neural
