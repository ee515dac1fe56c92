#include "neural/settled_maps.h"

#include <algorithm>

#include "core/threads.h"
#include "neural/guidance.h"
#include "neural/map_votes.h"
#include "neural/settling_cost.h"

namespace gramloom::neural {

namespace {

constexpr std::size_t most_tried = 1024, least_tried = 64;
constexpr double weight_of_map = 0.5;  // of its deviation, beside that of the colours
// Of a map's variance that like colours tell: of heights and roughnesses 0.3 to 1, of noise none.
constexpr double told_share = 0.15;

}  // namespace

std::vector<Layer> told_layers(const Exemplar& exemplar, Random random) {
  std::vector<PatchPlace> places = shuffled_places(exemplar, random.stream(0));
  const std::size_t count = std::min(most_tried, places.size() / 4);
  if (count < least_tried) return {};
  const auto first = places.begin(), last = first + static_cast<std::ptrdiff_t>(count);
  const std::vector<PatchPlace> tried(first, last);
  places.erase(first, last);
  places.resize(std::min(places.size(), std::size_t{settling_references}));
  const MapReferences references = references_at(exemplar, 0, std::move(places), random.stream(1));
  const std::vector<std::int32_t> found = nearest_reference(exemplar.image, tried, references);
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

void settle_maps(const Exemplar& exemplar, const std::vector<Layer>& layers, Tile tile,
                 Random random, const ImageRows& around, Rows own_rows, const Group& group,
                 Image& own) {
  if (layers.empty() || own.width < vote_side || around.height < vote_side) return;
  std::vector<PatchPlace> places = shuffled_places(exemplar, random.stream(0));
  places.resize(std::min(places.size(), std::size_t{settling_references}));
  const MapReferences references =
      references_at(exemplar, weight_of_map, std::move(places), random.stream(1));
  const PlacesFound field = places_found(around, own_rows, settled_margin, tile, references);
  const Votes votes(exemplar, references, field, layers, tile, around);
  const std::vector<float> share =
      shares_of_middle(exemplar, layers, votes, around, own_rows, group);
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