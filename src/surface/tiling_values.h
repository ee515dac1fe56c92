#pragma once

#include <span>
#include <vector>

#include "core/image.h"
#include "core/request.h"
#include "signal/colour_pca.h"
#include "surface/tiling.h"

namespace gramloom {

/// An exemplar in numbers that may be blended, and the way back.
///
/// For TileBlend::histogram each channel gets the standard normal distribution by rank, and back by
/// a table (Heitz, Neyret 2018); weights are divided by the root of the sum of their
/// squares, so that the blend has that distribution too, and the way back gives the exemplar's.
///   colour  its channels along their principal axes first (Deliot, Heitz 2019)
///   scalar, alpha  each channel as it is
///   normal  the slopes x/z and y/z of the vectors, less their mean, and no table: slopes of
///           surfaces that are blended add up. The results are of unit length
/// Departures: equal values get equal ranks, the middle of theirs, so that flat places stay flat;
/// the table is as wide as the exemplar's own normal values.
///
/// For TileBlend::contrast values stay as they are, but normals, which are slopes again; weights
/// are multiplied by 0.4 + 0.6 · prominence, and divided by their sum (Mikkelsen 2022).
/// Departure: the prominence is the map called "height" where there is one; else the lightness.
/// Masked pixels don't count; their own values are of no use.
class TilingValues {
 public:
  TilingValues(const Exemplar& exemplar, TileBlend blend);

  /// To be blended: the exemplar's size and number of channels.
  const Image& values() const { return values_; }
  /// TileBlend::contrast: what a pixel's weights are multiplied by; else empty.
  const Image& prominence() const { return prominence_; }
  /// For each channel: 1 where it and the next one are the slopes of a normal, right and up, which
  /// turn with a piece that is turned; −1 where they are right and down, as the layer's green says;
  /// else 0.
  const std::vector<float>& slopes() const { return slopes_; }
  /// Blended pixels become the exemplar's kind, in its range.
  void restore(float* pixels, int count) const;

 private:
  struct Table {
    float low = 0, scale = 0;   // position in the table = (value − low) · scale
    std::vector<float> values;  // none: the channel is as it is
  };
  struct Part {
    Layer layer;
    ColourPca axes;           // of colour
    std::vector<float> back;  // from normal values along the axes to colours: channels × channels
    std::vector<Table> tables;
    std::vector<float> mean_slopes, least_slopes, most_slopes;  // of normals
  };
  Part take_colour(const Image& exemplar, const Layer& layer);
  Part take_scalars(const Layer& layer);
  Part take_normals(const Image& exemplar, const Layer& layer);
  Table take_ranks(int channel);
  static void restore_colour(const Part& part, std::span<float> along, float* pixel);
  static void restore_normal(const Part& part, float* pixel);

  TileBlend blend_;
  std::vector<std::size_t> usable_;  // which pixels count
  Image values_, prominence_;
  std::vector<float> slopes_;
  std::vector<Part> parts_;
  ChannelRange range_;
};

}  // namespace gramloom
