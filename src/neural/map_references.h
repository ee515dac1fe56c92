#pragma once

#include <cstdint>
#include <vector>

#include "core/request.h"
#include "neural/flow/patch_axes.h"
#include "neural/network/rows.h"

namespace gramloom::neural {

// Where in the exemplar the places of a picture are found again, for settled_maps.h.

/// Side of a place, in pixels.
inline constexpr int vote_side = 3;

/// Which rows of a picture of `height` an image holds; rows beyond the edges go around the circle.
struct ImageRows {
  const Image& image;
  std::int64_t first = 0;
  std::int64_t height = 0;
};

/// The exemplar's places that are looked at, and what a picture's places are compared by.
struct MapReferences {
  std::vector<PatchPlace> places;
  PatchAxes axes;
  Vectors vectors;
  std::vector<float> offsets;
};

/// All usable places of the exemplar, in a random order.
std::vector<PatchPlace> shuffled_places(const Exemplar& exemplar, Random random);
/// References at these places. In units of its deviation each layer counts alike, however many
/// channels it has, and maps by `map_weight`.
MapReferences references_at(const Exemplar& exemplar, double map_weight,
                            std::vector<PatchPlace> places, Random random);
/// The number of the nearest reference for each of an image's places.
std::vector<std::int32_t> nearest_reference(const Image& image,
                                            const std::vector<PatchPlace>& places,
                                            const MapReferences& references);

/// The exemplar's nearest place for each place of a picture; row p has the places whose first row
/// is `first` + p.
struct PlacesFound {
  std::int64_t first = 0;
  std::int64_t columns = 0;
  std::vector<std::int32_t> reference;  // −1: none, beyond an edge

  std::int32_t at(std::int64_t row, std::int64_t column) const {
    return reference[static_cast<std::size_t>((row - first) * columns + column)];
  }
};

/// Of the places with a pixel in the own rows or in the `margin` rows above them.
PlacesFound places_found(const ImageRows& around, Rows own, std::int64_t margin, Tile tile,
                         const MapReferences& references);

/// The mean variance of these channels.
double variance_of(const Image& pixels, int first, int count);

}  // namespace gramloom::neural
