#include "neural/loss/directed_sliced.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/threads.h"
#include "neural/flow/guided_patches.h"
#include "neural/loss/barycentre.h"
#include "neural/loss/directed_places.h"
#include "neural/loss/mix_bins.h"
#include "neural/loss/patches.h"
#include "neural/loss/wasserstein.h"
#include "neural/normal_numbers.h"
#include "neural/picture.h"

namespace gramloom::neural {

namespace {

enum class DirectedStream : std::uint64_t { flat = 1, sample, exemplar, draws, tags, bins };

// Columns of rows of floats.
at::Tensor columns(const at::Tensor& rows, const Indices& wanted) {
  const std::int64_t count = std::ssize(wanted), length = rows.size(1);
  at::Tensor result = at::empty({rows.size(0), count}, at::kFloat);
  const float* from = rows.data_ptr<float>();
  float* to = result.data_ptr<float>();
  parallel_for(rows.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r < end; ++r)
      for (std::int64_t i = 0; i < count; ++i)
        to[r * count + i] = from[r * length + wanted[static_cast<std::size_t>(i)]];
  });
  return result;
}

void put_columns(const at::Tensor& some, const Indices& places, at::Tensor& rows) {
  const std::int64_t count = some.size(1), length = rows.size(1);
  const float* from = some.data_ptr<float>();
  float* to = rows.data_ptr<float>();
  for (std::int64_t r = 0; r < some.size(0); ++r)
    for (std::int64_t i = 0; i < count; ++i)
      to[r * length + places[static_cast<std::size_t>(i)]] = from[r * count + i];
}

class DirectedSliced : public PictureTerm {
 public:
  DirectedSliced(const SlicedParams& params, const LossInput& input)
      : exemplar_(input.exemplar.contiguous()),
        wraps_(input.target.tile),
        positions_(params.positions),
        directions_(input.directions),
        random_(input.random) {
    const Guidance& guidance = *input.guidance;
    const Size size = size_of(exemplar_), result = input.target.size;
    check_patches_fit(params.patch_sizes, size, result, wraps_);
    const int largest = *std::ranges::max_element(params.patch_sizes);
    for (const int side : params.patch_sizes) {
      places_.push_back(directed_places(guidance, size, result, side));
      if (input.nearest.defined())
        take_nearest(input.nearest, guidance, result, largest, places_.back());
    }
    const Image pixels = to_image(exemplar_);
    root_mean_square_ =
        static_cast<float>(std::sqrt(std::max(1e-12, mean_square_of(pixels, guidance.usable))));
    const Image usable = usable_pixels(pixels, guidance.usable);
    std::vector<double> sums(static_cast<std::size_t>(usable.channels));
    for (std::size_t i = 0; i < usable.pixels.size(); ++i)
      sums[i % sums.size()] += usable.pixels[i];
    for (const double sum : sums)
      mean_.push_back(static_cast<float>(sum / static_cast<double>(usable.width) / usable.height));
    find_flat();
  }

  double add(const at::Tensor& picture, double weight, std::uint64_t step,
             at::Tensor& gradient) const override {
    if (flat_ == 0) return add_colour(picture, weight, gradient);
    const DirectedPlaces& all = places_[step % places_.size()];
    if (all.counted.empty()) return 0;
    const Random random = random_.stream(step);
    const Indices sample =
        sample_of(std::ssize(all.counted), random.stream(part(DirectedStream::sample)));
    std::vector<PatchPlace> places;
    for (const std::int64_t i : sample) places.push_back(all.counted[static_cast<std::size_t>(i)]);
    const auto goals = goal_places(all, sample, random);
    const std::vector<MixBin> bins =
        mix_bins(all.shares, sample, random.stream(part(DirectedStream::bins)));
    const at::Tensor filters = filters_of(all.side, step);
    const at::Tensor tag_filters =
        normal_numbers(random.stream(part(DirectedStream::tags)), {directions_, all.tags.length});
    std::size_t most = places.size();
    for (const auto& of_exemplar : goals) most = std::max(most, of_exemplar.size());
    const std::int64_t at_once =
        std::max(least_directions_at_once, sliced_values_at_once / static_cast<std::int64_t>(most));
    double sum = 0;
    for (std::int64_t first = 0; first < directions_; first += at_once) {
      const std::int64_t count = std::min(at_once, directions_ - first);
      const at::Tensor some = filters.narrow(0, first, count);
      const at::Tensor tags = tags_of(all.tags, sample, tag_filters.narrow(0, first, count));
      at::Tensor values = project_list(picture, some, places);
      if (tags.defined()) values += tags;
      std::vector<at::Tensor> wanted;
      for (const auto& of_exemplar : goals) {
        wanted.push_back(project_exemplar(some, of_exemplar));
        if (tags.defined()) wanted.back() += tags;
      }
      const double own = weight * static_cast<double>(count) / directions_ / flat_;
      sum += compare(values, wanted, is_paired(all), bins, own) * static_cast<double>(count);
      spread_list(values, some, places, gradient);
    }
    return sum / directions_ / flat_;
  }

 private:
  static std::uint64_t part(DirectedStream stream) { return std::uint64_t(stream); }

  // Whether each patch has a goal of its own.
  static bool is_paired(const DirectedPlaces& places) {
    return !places.nearest.empty() || !places.draws.empty();
  }

  void find_flat() {
    const DirectedPlaces& places = places_.front();
    std::vector<PatchPlace> all;
    for (const auto& of_exemplar : places.usable)
      all.insert(all.end(), of_exemplar.begin(), of_exemplar.end());
    all = some_of(all, static_cast<std::size_t>(positions_),
                  random_.stream(part(DirectedStream::flat)));
    const at::Tensor filters = filters_of(places.side, 0);
    const std::int64_t at_once =
        std::max(least_directions_at_once, sliced_values_at_once / std::ssize(all));
    for (std::int64_t first = 0; first < directions_; first += at_once)
      flat_ += distance_from_mean(
          project_exemplar(filters.narrow(0, first, std::min(at_once, directions_ - first)), all));
    flat_ /= directions_;
    // The mean of equal values is rounded.
    if (flat_ < 1e-6 * double{root_mean_square_}) flat_ = 0;
  }

  // Of a flat exemplar the colour is all there is to match.
  double add_colour(const at::Tensor& picture, double weight, at::Tensor& gradient) const {
    const at::Tensor off = picture - at::tensor(mean_).view({-1, 1, 1});
    gradient.add_(off, weight * 2 / static_cast<double>(picture.numel()));
    return off.square().mean().item<double>();
  }

  // All of `count`, or about positions_ of them.
  Indices sample_of(std::int64_t count, Random random) const {
    Indices sample;
    if (count <= positions_) {
      sample.resize(static_cast<std::size_t>(count));
      std::iota(sample.begin(), sample.end(), 0);
      return sample;
    }
    const float share = static_cast<float>(positions_) / static_cast<float>(count);
    for (std::int64_t i = 0; i < count; ++i)
      if (random.uniform() < share) sample.push_back(i);
    return sample;
  }

  // The exemplars' patches of the step: of each that is mixed.
  std::vector<std::vector<PatchPlace>> goal_places(const DirectedPlaces& all, const Indices& sample,
                                                   Random random) const {
    std::vector<std::vector<PatchPlace>> goals(all.usable.size());
    for (std::size_t e = 0; e < goals.size(); ++e) {
      Random own = random.stream(part(DirectedStream::draws)).stream(e);
      if (!all.nearest.empty()) {
        for (const std::int64_t i : sample)
          goals[e].push_back(all.nearest[e][static_cast<std::size_t>(i)]);
      } else if (!all.draws.empty()) {
        for (const std::int64_t i : sample)
          goals[e].push_back(all.usable[e][static_cast<std::size_t>(all.draws[e].draw(i, own))]);
      } else {
        goals[e] = some_of(all.usable[e], static_cast<std::size_t>(positions_), own);
      }
    }
    return goals;
  }

  at::Tensor filters_of(int side, std::uint64_t step) const {
    const std::int64_t channels = exemplar_.size(0);
    return random_directions(random_.stream(step), directions_, channels * side * side)
        .view({directions_, channels, side, side});
  }

  // (filters, patches of the sample): what the guide adds to both sides; nothing without one.
  at::Tensor tags_of(const GuideRows& tags, const Indices& sample,
                     const at::Tensor& filters) const {
    if (tags.length == 0) return {};
    const std::int64_t count = std::ssize(sample), directions = filters.size(0);
    at::Tensor result = at::empty({directions, count}, at::kFloat);
    float* to = result.data_ptr<float>();
    const at::Tensor weights = filters.contiguous();
    const float* weight = weights.data_ptr<float>();
    parallel_for(directions, 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t d = begin; d < end; ++d)
        for (std::int64_t i = 0; i < count; ++i) {
          const float* tag = tags.at(sample[static_cast<std::size_t>(i)]);
          to[d * count + i] =
              root_mean_square_ *
              std::inner_product(tag, tag + tags.length, weight + d * tags.length, 0.0f);
        }
    });
    return result;
  }

  // Patches of the exemplar along filters. Of about all of them it is quicker to take all.
  at::Tensor project_exemplar(const at::Tensor& filters,
                              const std::vector<PatchPlace>& places) const {
    const Size whole = patch_places(size_of(exemplar_), static_cast<int>(filters.size(2)));
    const std::int64_t count = std::int64_t{whole.width} * whole.height;
    if (2 * std::ssize(places) < count || count > positions_)
      return project_list(exemplar_, filters, places);
    Indices indices;
    for (const PatchPlace p : places) indices.push_back(std::int64_t{p.y} * whole.width + p.x);
    return columns(project_patches(exemplar_, filters, Tile::none), indices);
  }

  // The mean distance of `values` from their goals; they become `weight` times its gradient.
  static double compare(at::Tensor& values, std::vector<at::Tensor>& wanted, bool paired,
                        const std::vector<MixBin>& bins, double weight) {
    if (!paired)
      for (at::Tensor& of_exemplar : wanted) sort_rows(of_exemplar);
    const auto total = static_cast<double>(values.size(1));
    double sum = 0;
    for (const MixBin& bin : bins) {
      const bool whole = bins.size() == 1;
      const std::int64_t count = std::ssize(bin.members);
      std::vector<at::Tensor> goals;
      for (std::size_t e = 0; e < wanted.size(); ++e) {
        at::Tensor goal = wanted[e];
        if (paired) {
          if (!whole) goal = columns(goal, bin.members);
          sort_rows(goal);
        }
        goals.push_back(goal);
      }
      const at::Tensor goal =
          goals.size() == 1 ? goals.front() : barycentre(goals, bin.shares, count);
      const double share = static_cast<double>(count) / total;
      if (whole) return wasserstein(values, goal, weight);
      at::Tensor own = columns(values, bin.members);
      sum += share * wasserstein(own, goal, weight * share);
      put_columns(own, bin.members, values);
    }
    return sum;
  }

  at::Tensor exemplar_;
  Tile wraps_;
  std::int64_t positions_;  // at most, whose patches are compared
  int directions_;
  Random random_;
  std::vector<DirectedPlaces> places_;  // of each patch size: steps take turns
  float root_mean_square_ = 1;          // of the exemplar's usable values
  std::vector<float> mean_;             // likewise, of each channel
  double flat_ = 0;                     // as that of sliced.cpp
};

}  // namespace

std::unique_ptr<PictureTerm> make_directed_sliced(const SlicedParams& params,
                                                  const LossInput& input) {
  return std::make_unique<DirectedSliced>(params, input);
}

}  // namespace gramloom::neural
