#pragma once

#include <vector>

#include "neural/group.h"
#include "neural/map_references.h"

namespace gramloom::neural {

// What the exemplar's places say of a picture's maps, for settled_maps.h.

/// What each pixel's maps become: the mean of its nine votes, and of those the one whose place has
/// it in the middle; both with what follows from the pixel's colours, which are not quite those of
/// the places that vote.
class Votes {
 public:
  Votes(const Exemplar& exemplar, const MapReferences& references, const PlacesFound& field,
        const std::vector<Layer>& layers, Tile tile, const ImageRows& around);

  /// Of pixel (x, row) of the picture, in the channels of the layers; in those of the colours, what
  /// the votes have.
  void at(int x, std::int64_t row, float* mean, float* middle) const;

  /// f(channel) for each of the layers'.
  template <class F>
  void for_each_channel(F&& f) const {
    for (const Layer& layer : layers_)
      for (int c = layer.first; c < layer.first + layer.count; ++c) f(c);
  }

 private:
  const float* vote_of(int column, std::int64_t row, int dx, int dy) const;

  const Exemplar& exemplar_;
  const MapReferences& references_;
  const PlacesFound& field_;
  const std::vector<Layer>& layers_;
  Tile tile_;
  const ImageRows& around_;
  Image slopes_;  // a column a colour, a row a channel
};

/// How much of what its middle votes add each channel gets, 0 to 1: so much that its layer's steps
/// from pixel to pixel are as large as the exemplar's. Of the picture's own rows; all processes say
/// it together.
std::vector<float> shares_of_middle(const Exemplar& exemplar, const std::vector<Layer>& layers,
                                    const Votes& votes, const ImageRows& around, Rows own,
                                    const Group& group);

}  // namespace gramloom::neural
