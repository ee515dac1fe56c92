#include "neural/map_references.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "neural/flow/nearest.h"
#include "neural/guidance.h"
#include "neural/settling_cost.h"
#include "signal/layer_axes.h"
#include "signal/united.h"

namespace gramloom::neural {

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

namespace {

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

}  // namespace

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

std::vector<std::int32_t> nearest_reference(const Image& image,
                                            const std::vector<PatchPlace>& places,
                                            const MapReferences& references) {
  return nearest_references(project(image, places, references.axes), references.vectors,
                            references.offsets, 1, 1)
      .reference;
}

PlacesFound places_found(const ImageRows& around, Rows own, std::int64_t margin, Tile tile,
                         const MapReferences& references) {
  const int width = around.image.width;
  PlacesFound field{own.begin - margin, tiles_x(tile) ? width : width - vote_side + 1, {}};
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
    const std::vector<std::int32_t> found = nearest_reference(around.image, places, references);
    for (std::size_t i = 0; i < found.size(); ++i) field.reference[index[i]] = found[i];
  }
  return field;
}

}  // namespace gramloom::neural
