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

// Of each row.
std::vector<Potential> potentials_of(const at::Tensor& values, const at::Tensor& goal) {
  const auto row = [](const at::Tensor& rows, std::int64_t r) {
    return std::span(rows.data_ptr<float>() + r * rows.size(1),
                     static_cast<std::size_t>(rows.size(1)));
  };
  std::vector<Potential> potentials(static_cast<std::size_t>(values.size(0)));
  parallel_for(values.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r < end; ++r)
      potentials[static_cast<std::size_t>(r)] = Potential(row(values, r), row(goal, r));
  });
  return potentials;
}

class SlicedTerm : public PictureTerm {
 public:
  SlicedTerm(const SlicedParams& params, const LossInput& input)
      : exemplar_(input.exemplar),
        wraps_(input.target.tile),
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
      gradient.add_(off, weight * 2 / static_cast<double>(picture.numel()));
      return off.square().mean().item<double>();
    }
    const std::int64_t at_once =
        directions_at_once(std::max(pixels_of(picture), pixels_of(exemplar_)));
    double sum = 0;
    for_each_group(filters(step), at_once, [&](const at::Tensor& some) {
      const double own = weight * static_cast<double>(some.size(0)) / directions_ / flat_;
      const bool all = PatchPositions(picture, some.size(2), wraps_).count() <= positions_;
      const double distance = all ? add_all(picture, some, own, step, gradient)
                                  : add_sampled(picture, some, own, step, gradient);
      sum += distance * static_cast<double>(some.size(0));
    });
    return sum / directions_ / flat_;
  }

 private:
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

  // The patches of the step's sample of a picture's positions along some directions.
  at::Tensor sampled(const at::Tensor& picture, const at::Tensor& filters, Tile wraps,
                     std::uint64_t step) const {
    const PatchPositions all(picture, filters.size(2), wraps);
    const PatchSample sample(all, positions_, random_.stream(step).stream(0));
    return project_sample(picture, filters, wraps, sample);
  }

  // The exemplar's patches, all or of a sample.
  at::Tensor goal(const at::Tensor& filters, std::uint64_t step) const {
    if (PatchPositions(exemplar_, filters.size(2), Tile::none).count() > positions_)
      return sampled(exemplar_, filters, Tile::none, step);
    return project_patches(exemplar_, filters, Tile::none);
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
    const auto potentials =
        potentials_of(sampled(picture, filters, wraps_, step), goal(filters, step));
    const auto positions =
        static_cast<double>(PatchPositions(picture, filters.size(2), wraps_).count());
    const auto directions = static_cast<double>(filters.size(0));
    const auto slope = static_cast<float>(weight / positions / directions);
    add_slopes(
        picture, filters, wraps_,
        [&](std::int64_t filter, std::span<float> products) {
          potentials[static_cast<std::size_t>(filter)].to_slopes(products, slope);
        },
        gradient);
    double sum = 0;
    for (const Potential& potential : potentials) sum += potential.distance();
    return sum / directions;
  }

  at::Tensor exemplar_;
  Tile wraps_;  // the edges across which patches of the result go on; the exemplar's stay inside
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
