#pragma once

#include <vector>

#include "core/request.h"
#include "signal/colour_pca.h"

namespace gramloom {

/// Channels [first, first + count) of an image.
struct ChannelBlock {
  int first = 0;
  int count = 0;

  friend bool operator==(const ChannelBlock&, const ChannelBlock&) = default;
};

/// The channels that may be mixed with each other, in order: those of a layer of colours or of a
/// normal; each channel of other layers by itself. Without layers, all of them.
std::vector<ChannelBlock> channel_blocks(const std::vector<Layer>& layers, int channels);

/// Principal axes of each block by itself, as one set: an axis has components in its block alone,
/// and by falling deviation only there.
ColourPca principal_axes(const Image& image, const std::vector<ChannelBlock>& blocks);

/// Axes that are not correlated on the image, for work on one at a time, although layers are not
/// mixed: first those of the first block (the picture's colours), as if there were no others; of
/// every later block what these and the blocks before don't tell of it linearly (Gram, Schmidt).
/// So colours come out as they do without maps, whatever the maps are, and the maps follow them.
struct LayerAxes {
  ColourPca own;              // of each block
  std::vector<float> shares;  // channels × channels, lower triangular: what each of those axes has
                              // of the axes here; a zero on the diagonal: it is all told by others

  bool is_flat(int axis) const;
};
LayerAxes layer_axes(const Image& image, const std::vector<Layer>& layers);

/// Values along these axes, of mean 0 and variance 1 on the image they were taken from, and 0
/// along flat ones; and the inverse. Both throw Error when the numbers of channels differ.
Image whitened(const Image& image, const LayerAxes& axes);
Image unwhitened(const Image& image, const LayerAxes& axes);

}  // namespace gramloom
