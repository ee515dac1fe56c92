#include "neural/settled_maps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/threads.h"
#include "neural/flow/patch_axes.h"
#include "neural/guidance.h"
#include "neural/settling_cost.h"
#include "neural/shared_rows.h"
#include "signal/layer_axes.h"
#include "signal/united.h"

namespace gramloom::neural {

namespace {

constexpr int vote_side = 3;
constexpr std::size_t most_tried = 1024, least_tried = 64;
constexpr double weight_of_map = 0.5;  // of its deviation, beside that of the colours
// Of a map's variance that like colours tell: of heights and roughnesses 0.3 to 1, of noise none.
constexpr double told_share = 0.15;

// The exemplar's places that are looked at, and what a picture's places are compared by.
struct MapReferences {
  std::vector<PatchPlace> places;
  PatchAxes axes;
  Vectors vectors;
  std::vector<float> offsets;
};

double variance_of(const Image& pixels, int first, int count) {
  double variance = 0;
  for (int c = first; c < first + count; ++c) {
    double sum = 0, squares = 0;
    for (std::size_t i = static_cast<std::size_t>(c); i < pixels.pixels.size();
         i += static_cast<std::size_t>(pixels.channels)) {
      sum += double{pixels.pixels[i]};
      squares += double{pixels.pixels[i]} * double{pixels.pixels[i]};
    }
    const double n = static_cast<double>(pixels.pixels.size()) / pixels.channels;
    variance += std::max(0.0, squares / n - sum * sum / (n * n)) / count;
  }
  return variance;
}

// In units of its deviation each layer counts alike, however many channels it has; maps for less.
std::vector<float> channel_scales(const Exemplar& exemplar, double map_weight) {
  const Image pixels = usable_pixels(exemplar.image, exemplar.mask);
  std::vector<float> scales;
  for (const ChannelBlock& block : channel_blocks(exemplar.layers, exemplar.image.channels)) {
    const double variance = variance_of(pixels, block.first, block.count);
    const double weight = block.first == 0 ? 1 : map_weight;
    const double scale = variance > 1e-10 ? weight / std::sqrt(variance * block.count) : 0;
    scales.insert(scales.end(), static_cast<std::size_t>(block.count), static_cast<float>(scale));
  }
  return scales;
}

// Axes along which patches in their own units are as far apart as scaled ones are.
PatchAxes scaled_axes(const Exemplar& exemplar, double map_weight,
                      const std::vector<PatchPlace>& places, Random random) {
  const std::vector<float> scales = channel_scales(exemplar, map_weight);
  Image scaled = exemplar.image;
  for (std::size_t i = 0; i < scaled.pixels.size(); ++i)
    scaled.pixels[i] *= scales[i % scales.size()];
  PatchAxes axes = patch_axes(scaled, vote_side, settling_axes, random, places);
  for (std::size_t i = 0; i < axes.axes.values.size(); ++i)
    axes.axes.values[i] *= scales[i % scales.size()];
  return axes;
}

// All usable places, in a random order.
std::vector<PatchPlace> shuffled_places(const Exemplar& exemplar, Random random) {
  const auto usable = usable_origins(exemplar.mask, exemplar.image.size(), {vote_side, vote_side});
  const int columns = patch_places(exemplar.image.size(), vote_side).width;
  std::vector<PatchPlace> places;
  for (std::size_t i = 0; i < usable.size(); ++i)
    if (usable[i]) places.push_back({static_cast<int>(i) % columns, static_cast<int>(i) / columns});
  for (std::size_t i = places.size(); i > 1; --i)
    std::swap(places[i - 1], places[random.below(static_cast<std::uint32_t>(i))]);
  return places;
}

MapReferences references_at(const Exemplar& exemplar, double map_weight,
                            std::vector<PatchPlace> places, Random random) {
  MapReferences found{std::move(places), {}, {}, {}};
  found.axes = scaled_axes(exemplar, map_weight, found.places, random);
  found.vectors = project(exemplar.image, found.places, found.axes);
  for (std::int64_t i = 0; i < found.vectors.count; ++i) {
    const float* v = found.vectors.at(i);
    found.offsets.push_back(std::inner_product(v, v + found.vectors.dimensions, v, 0.0f));
  }
  return found;
}

std::vector<std::int32_t> nearest(const Image& image, const std::vector<PatchPlace>& places,
                                  const MapReferences& references) {
  return nearest_references(project(image, places, references.axes), references.vectors,
                            references.offsets, 1, 1)
      .reference;
}

// The exemplar's nearest place for each place of a picture; row p has the places whose first row is
// `first` + p.
struct PlacesFound {
  std::int64_t first = 0;
  std::int64_t columns = 0;
  std::vector<std::int32_t> reference;  // −1: none, beyond an edge

  std::int32_t at(std::int64_t row, std::int64_t column) const {
    return reference[static_cast<std::size_t>((row - first) * columns + column)];
  }
};

PlacesFound places_found(const ImageRows& around, Rows own, Tile tile,
                         const MapReferences& references) {
  const int width = around.image.width;
  PlacesFound field{own.begin - settled_margin, tiles_x(tile) ? width : width - vote_side + 1, {}};
  constexpr std::int64_t rows_at_once = 32;  // so that their vectors take little memory
  for (std::int64_t row = field.first; row < own.end; row += rows_at_once) {
    std::vector<PatchPlace> places;
    std::vector<std::size_t> index;
    for (std::int64_t p = row; p < std::min(row + rows_at_once, own.end); ++p) {
      const bool there = tiles_y(tile) || (p >= 0 && p + vote_side <= around.height);
      for (int x = 0; x < field.columns; ++x, field.reference.push_back(-1))
        if (there) {
          const std::int64_t held = (p - around.first + around.height) % around.height;
          places.push_back({x, static_cast<int>(held)});
          index.push_back(field.reference.size());
        }
    }
    if (places.empty()) continue;
    const std::vector<std::int32_t> found = nearest(around.image, places, references);
    for (std::size_t i = 0; i < found.size(); ++i) field.reference[index[i]] = found[i];
  }
  return field;
}

}  // namespace

std::vector<Layer> told_layers(const Exemplar& exemplar, Random random) {
  std::vector<PatchPlace> places = shuffled_places(exemplar, random.stream(0));
  const std::size_t count = std::min(most_tried, places.size() / 4);
  if (exemplar.layers.size() < 2 || count < least_tried) return {};
  const auto first = places.begin(), last = first + static_cast<std::ptrdiff_t>(count);
  const std::vector<PatchPlace> tried(first, last);
  places.erase(first, last);
  places.resize(std::min(places.size(), std::size_t{settling_references}));
  const MapReferences references = references_at(exemplar, 0, std::move(places), random.stream(1));
  const std::vector<std::int32_t> found = nearest(exemplar.image, tried, references);
  const Image pixels = usable_pixels(exemplar.image, exemplar.mask);
  std::vector<Layer> layers;
  for (const Layer& layer : exemplar.layers) {
    // Coverage is all or nothing: a mean of votes would be neither.
    if (layer.first == 0 || layer.kind == MapKind::alpha) continue;
    double wrong = 0;
    for (std::size_t i = 0; i < tried.size(); ++i) {
      const PatchPlace from = references.places[static_cast<std::size_t>(found[i])];
      for (int c = layer.first; c < layer.first + layer.count; ++c) {
        const double d = double{exemplar.image.at(from.x + 1, from.y + 1)[c]} -
                         double{exemplar.image.at(tried[i].x + 1, tried[i].y + 1)[c]};
        wrong += d * d / layer.count / static_cast<double>(tried.size());
      }
    }
    if (wrong <= (1 - told_share) * variance_of(pixels, layer.first, layer.count))
      layers.push_back(layer);
  }
  return layers;
}

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

// What each pixel's maps become: the mean of its nine votes, and of those the one whose place has
// it in the middle; both with what follows from the pixel's colours, which are not quite those of
// the places that vote.
class Votes {
 public:
  Votes(const Exemplar& exemplar, const MapReferences& references, const PlacesFound& field,
        const std::vector<Layer>& layers, Tile tile, const ImageRows& around)
      : exemplar_(exemplar),
        references_(references),
        field_(field),
        layers_(layers),
        tile_(tile),
        around_(around),
        slopes_(slopes_of(exemplar, layers)) {}

  // Of pixel (x, row) of the picture, in the channels of the layers; in those of the colours, what
  // the votes have.
  void at(int x, std::int64_t row, float* mean, float* middle) const {
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

  template <class F>
  void for_each_channel(F&& f) const {
    for (const Layer& layer : layers_)
      for (int c = layer.first; c < layer.first + layer.count; ++c) f(c);
  }

 private:
  const float* vote_of(int column, std::int64_t row, int dx, int dy) const {
    const int width = around_.image.width;
    if (tiles_x(tile_)) column = (column + width) % width;
    if (column < 0 || column >= field_.columns) return nullptr;
    const std::int32_t r = field_.at(row, column);
    if (r < 0) return nullptr;
    const PatchPlace from = references_.places[static_cast<std::size_t>(r)];
    return exemplar_.image.at(from.x + dx, from.y + dy);
  }

  const Exemplar& exemplar_;
  const MapReferences& references_;
  const PlacesFound& field_;
  const std::vector<Layer>& layers_;
  Tile tile_;
  const ImageRows& around_;
  Image slopes_;  // a column a colour, a row a channel
};

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

void settle_maps(const Exemplar& exemplar, const std::vector<Layer>& layers, Tile tile,
                 Random random, const ImageRows& around, Rows own_rows, const Group& group,
                 Image& own) {
  if (layers.empty() || own.width < vote_side || around.height < vote_side) return;
  std::vector<PatchPlace> places = shuffled_places(exemplar, random.stream(0));
  places.resize(std::min(places.size(), std::size_t{settling_references}));
  const MapReferences references =
      references_at(exemplar, weight_of_map, std::move(places), random.stream(1));
  const PlacesFound field = places_found(around, own_rows, tile, references);
  const Votes votes(exemplar, references, field, layers, tile, around);
  const Steps steps = steps_of(votes, own_rows, own);
  const double count = static_cast<double>(around.height) * (own.width - 1) +
                       static_cast<double>(around.height - 1) * own.width;
  std::vector<float> share(static_cast<std::size_t>(own.channels));
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
  parallel_for(own.height, 8, [&](std::int64_t begin, std::int64_t end) {
    std::vector<float> mean(share.size()), middle(share.size());
    for (std::int64_t y = begin; y < end; ++y)
      for (int x = 0; x < own.width; ++x) {
        votes.at(x, own_rows.begin + y, mean.data(), middle.data());
        float* pixel = own.at(x, static_cast<int>(y));
        votes.for_each_channel([&](int c) {
          const auto i = static_cast<std::size_t>(c);
          pixel[c] = mean[i] + share[i] * (middle[i] - mean[i]);
        });
      }
  });
}

}  // namespace gramloom::neural
