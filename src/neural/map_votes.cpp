#include "neural/map_votes.h"

#include <ATen/ATen.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/threads.h"
#include "neural/shared_rows.h"

namespace gramloom::neural {

namespace {

// f(from, to) for each two neighbours, along a row or down a column, of usable pixels.
template <class F>
void for_each_step(const Exemplar& exemplar, F&& f) {
  const Image& image = exemplar.image;
  const auto usable = [&](int x, int y) {
    return exemplar.mask.empty() || *exemplar.mask.at(x, y) > 0.5f;
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (!usable(x, y)) continue;
      if (x > 0 && usable(x - 1, y)) f(image.at(x - 1, y), image.at(x, y));
      if (y > 0 && usable(x, y - 1)) f(image.at(x, y - 1), image.at(x, y));
    }
}

// How the channels of some layers step from pixel to pixel when the colours, which are the first
// layer, do: least squares over all neighbours in the exemplar. Row c of the result is of channel
// c.
Image slopes_of(const Exemplar& exemplar, const std::vector<Layer>& layers) {
  const Image& image = exemplar.image;
  const int colours = exemplar.layers.front().count;
  at::Tensor of_colours = at::zeros({colours, colours}, at::kDouble);
  at::Tensor with_maps = at::zeros({colours, image.channels}, at::kDouble);
  double* squares = of_colours.data_ptr<double>();
  double* products = with_maps.data_ptr<double>();
  std::vector<double> step(static_cast<std::size_t>(image.channels)), squared(step);
  for_each_step(exemplar, [&](const float* from, const float* to) {
    for (std::size_t c = 0; c < step.size(); ++c) {
      step[c] = double{to[c]} - double{from[c]};
      squared[c] += step[c] * step[c];
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(colours); ++k) {
      for (std::size_t l = 0; l < static_cast<std::size_t>(colours); ++l)
        squares[k * static_cast<std::size_t>(colours) + l] += step[k] * step[l];
      for (std::size_t c = 0; c < step.size(); ++c)
        products[k * step.size() + c] += step[k] * step[c];
    }
  });
  // Colours that always step together tell no more than one of them.
  constexpr double least = 1e-6;
  const double mean = of_colours.trace().item<double>() / colours;
  Image slopes(colours, image.channels, 1, 0.0f);
  if (mean <= 0) return slopes;
  const at::Tensor solved =
      at::linalg_solve(of_colours + least * mean * at::eye(colours, at::kDouble), with_maps);
  // What the colours explain of a layer's steps, of all its channels.
  const at::Tensor explained = (solved * with_maps).sum(0);
  for (const Layer& layer : layers) {
    double whole = 0, known = 0;
    for (int c = layer.first; c < layer.first + layer.count; ++c) {
      whole += squared[static_cast<std::size_t>(c)];
      known += explained[c].item<double>();
    }
    const double share = whole > 0 ? std::clamp(known / whole, 0.0, 1.0) : 0;
    for (int c = layer.first; c < layer.first + layer.count; ++c)
      for (int k = 0; k < colours; ++k)
        *slopes.at(k, c) = static_cast<float>(share * solved[k][c].item<double>());
  }
  return slopes;
}

}  // namespace

Votes::Votes(const Exemplar& exemplar, const MapReferences& references, const PlacesFound& field,
             const std::vector<Layer>& layers, Tile tile, const ImageRows& around)
    : exemplar_(exemplar),
      references_(references),
      field_(field),
      layers_(layers),
      tile_(tile),
      around_(around),
      slopes_(slopes_of(exemplar, layers)) {}

void Votes::at(int x, std::int64_t row, float* mean, float* middle) const {
  const auto all = static_cast<std::size_t>(exemplar_.image.channels);
  std::fill_n(mean, all, 0.0f);
  float votes = 0;
  const float* in_middle = nullptr;
  for (int dy = 0; dy < vote_side; ++dy)
    for (int dx = 0; dx < vote_side; ++dx) {
      const float* vote = vote_of(x - dx, row - dy, dx, dy);
      if (!vote) continue;
      for (std::size_t c = 0; c < all; ++c) mean[c] += vote[c];
      ++votes;
      if (dx == 1 && dy == 1) in_middle = vote;
    }
  for (std::size_t c = 0; c < all; ++c) mean[c] /= votes;
  std::copy_n(in_middle ? in_middle : mean, all, middle);
  const std::int64_t held = (row - around_.first + around_.height) % around_.height;
  const float* colours = around_.image.at(x, static_cast<int>(held));
  for_each_channel([&](int c) {
    for (int k = 0; k < slopes_.width; ++k) {
      mean[c] += *slopes_.at(k, c) * (colours[k] - mean[k]);
      middle[c] += *slopes_.at(k, c) * (colours[k] - middle[k]);
    }
  });
}

const float* Votes::vote_of(int column, std::int64_t row, int dx, int dy) const {
  const int width = around_.image.width;
  if (tiles_x(tile_)) column = (column + width) % width;
  if (column < 0 || column >= field_.columns) return nullptr;
  const std::int32_t r = field_.at(row, column);
  if (r < 0) return nullptr;
  const PatchPlace from = references_.places[static_cast<std::size_t>(r)];
  return exemplar_.image.at(from.x + dx, from.y + dy);
}

namespace {

// Sums of squared steps from pixel to pixel, of each channel: of the means, of what the middle
// votes add, and of both together.
struct Steps {
  std::vector<double> mean, added, both;
  explicit Steps(int channels)
      : mean(static_cast<std::size_t>(channels)), added(mean), both(mean) {}
};

Steps steps_of(const Votes& votes, Rows own, const Image& like) {
  const auto channels = static_cast<std::size_t>(like.channels);
  const auto values = channels * static_cast<std::size_t>(like.width);
  constexpr std::int64_t grain = 8;
  const std::int64_t bands = (own.count() + grain - 1) / grain;
  std::vector<Steps> of_band(static_cast<std::size_t>(bands), Steps(like.channels));
  parallel_for(bands, 1, [&](std::int64_t begin, std::int64_t end) {
    std::vector<float> mean(values), middle(values), mean_above(values), middle_above(values);
    for (std::int64_t band = begin; band < end; ++band) {
      Steps& steps = of_band[static_cast<std::size_t>(band)];
      const auto add = [&](std::size_t at, const std::vector<float>& m, const std::vector<float>& k,
                           std::size_t from) {
        votes.for_each_channel([&](int c) {
          const auto i = static_cast<std::size_t>(c);
          const double step = double{mean[at + i]} - double{m[from + i]};
          const double more = double{middle[at + i]} - double{k[from + i]} - step;
          steps.mean[i] += step * step;
          steps.added[i] += more * more;
          steps.both[i] += step * more;
        });
      };
      const std::int64_t last = std::min(own.begin + (band + 1) * grain, own.end);
      for (std::int64_t y = own.begin + band * grain - 1; y < last; ++y) {
        if (y < 0) continue;  // there is nothing above the first row
        for (int x = 0; x < like.width; ++x) {
          const std::size_t at = static_cast<std::size_t>(x) * channels;
          votes.at(x, y, mean.data() + at, middle.data() + at);
        }
        if (y >= own.begin + band * grain)
          for (int x = 0; x < like.width; ++x) {
            const std::size_t at = static_cast<std::size_t>(x) * channels;
            if (x > 0) add(at, mean, middle, at - channels);
            if (y > 0) add(at, mean_above, middle_above, at);
          }
        std::swap(mean, mean_above);
        std::swap(middle, middle_above);
      }
    }
  });
  Steps all(like.channels);
  for (const Steps& steps : of_band)
    for (std::size_t c = 0; c < channels; ++c) {
      all.mean[c] += steps.mean[c];
      all.added[c] += steps.added[c];
      all.both[c] += steps.both[c];
    }
  return all;
}

// The mean squared step of a layer of the exemplar, times how many steps the picture has.
double steps_wanted(const Exemplar& exemplar, const Layer& layer, double count) {
  double sum = 0, n = 0;
  for_each_step(exemplar, [&](const float* from, const float* to) {
    ++n;
    for (int c = layer.first; c < layer.first + layer.count; ++c)
      sum += (double{to[c]} - double{from[c]}) * (double{to[c]} - double{from[c]});
  });
  return n > 0 ? sum / n * count : 0;
}

// How much of what the middle votes add gives steps of `wanted`: the root of a quadratic, 0 to 1.
double share_added(double mean, double both, double added, double wanted) {
  if (mean >= wanted || added <= 0) return 0;
  const double root = std::sqrt(std::max(0.0, both * both - added * (mean - wanted)));
  return std::clamp((root - both) / added, 0.0, 1.0);
}

}  // namespace

std::vector<float> shares_of_middle(const Exemplar& exemplar, const std::vector<Layer>& layers,
                                    const Votes& votes, const ImageRows& around, Rows own,
                                    const Group& group) {
  const Steps steps = steps_of(votes, own, around.image);
  const int width = around.image.width;
  const double count = static_cast<double>(around.height) * (width - 1) +
                       static_cast<double>(around.height - 1) * width;
  std::vector<float> share(static_cast<std::size_t>(around.image.channels));
  for (const Layer& layer : layers) {
    const auto sum = [&](const std::vector<double>& of) {
      return sum_of(group, std::accumulate(of.begin() + layer.first,
                                           of.begin() + layer.first + layer.count, 0.0));
    };
    const double mean = sum(steps.mean), both = sum(steps.both), added = sum(steps.added);
    std::fill_n(
        share.begin() + layer.first, layer.count,
        static_cast<float>(share_added(mean, both, added, steps_wanted(exemplar, layer, count))));
  }
  return share;
}

}  // namespace gramloom::neural
