#include "neural/loss/sliced.h"

#include "neural/loss/loss_term.h"
#include "neural/loss/patches.h"
#include "neural/loss/wasserstein.h"

namespace gramloom::neural {

namespace {

// Calls f(some of the filters), few enough for that many positions.
template <class F>
void for_each_group(const at::Tensor& filters, std::int64_t positions, F&& f) {
  const std::int64_t at_once =
      std::max(least_directions_at_once, sliced_values_at_once / positions);
  for (std::int64_t first = 0; first < filters.size(0); first += at_once)
    f(filters.narrow(0, first, std::min(at_once, filters.size(0) - first)));
}

class SlicedTerm : public PictureTerm {
 public:
  SlicedTerm(const SlicedParams& params, const LossInput& input)
      : exemplar_(input.exemplar),
        wraps_(input.target.tile),
        patch_sizes_(params.patch_sizes),
        directions_(input.directions),
        random_(input.random) {
    check_patches_fit(patch_sizes_, size_of(exemplar_), input.target.size, wraps_);
    for_each_group(filters(0), exemplar_.numel() / exemplar_.size(0), [&](const at::Tensor& some) {
      flat_ += distance_from_mean(project_patches(exemplar_, some, Tile::none));
    });
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
    const std::int64_t positions = std::max(picture.numel(), exemplar_.numel()) / picture.size(0);
    double sum = 0;
    for_each_group(filters(step), positions, [&](const at::Tensor& some) {
      const auto count = static_cast<double>(some.size(0));
      at::Tensor goal = project_patches(exemplar_, some, Tile::none);
      sort_rows(goal);
      at::Tensor values = project_patches(picture, some, wraps_);
      sum += wasserstein(values, goal, weight * count / directions_ / flat_) * count;
      spread_patches(values, some, wraps_, gradient);
    });
    return sum / directions_ / flat_;
  }

 private:
  // (directions, channels, side, side): unit vectors; step i has patch_sizes[i mod their number].
  at::Tensor filters(std::uint64_t step) const {
    const std::int64_t side = patch_sizes_[step % patch_sizes_.size()],
                       channels = exemplar_.size(0);
    return random_directions(random_.stream(step), directions_, channels * side * side)
        .view({directions_, channels, side, side});
  }

  at::Tensor exemplar_;
  Tile wraps_;  // the edges across which patches of the result go on; the exemplar's stay inside
  std::vector<int> patch_sizes_;
  int directions_;
  Random random_;
  double flat_ = 0;  // the exemplar's distance from a flat picture; 0: it is flat itself
};

}  // namespace

std::unique_ptr<PictureTerm> make_term(const SlicedParams& params, const LossInput& input) {
  return std::make_unique<SlicedTerm>(params, input);
}

}  // namespace gramloom::neural
