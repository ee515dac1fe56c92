#pragma once

#include <oneapi/dnnl/dnnl.hpp>
#include <span>
#include <vector>

#include "core/image.h"
#include "learnt/plain_generator.h"

namespace gramloom {

/// Values of a level on a rectangle of pixels: channels in blocks of `block`, each block a plane of
/// interleaved pixels (oneDNN's nChw16c or nChw8c). Channels beyond `channels` are 0.
struct ChannelPlanes {
  Size size;
  int channels = 0;
  int block = 16;
  dnnl::memory memory;

  ChannelPlanes() = default;
  ChannelPlanes(Size size_, int channels_);
  /// The block's channels of pixel i, row by row.
  float* at(int channel, std::size_t pixel) const;
};

/// How a level's channels are scaled and shifted for each material, of a mix that changes from
/// pixel to pixel: a value a material and pixel, pixels after each other.
using PixelShares = std::span<const float>;

/// The network of one level on rectangles of one size, zeros around it: pixels nearer to the border
/// than the level has convolutions are wrong, and not to be used.
class LevelNetwork {
 public:
  /// `shares` of the materials, if they are everywhere the same; empty: run() is given them.
  LevelNetwork(const GeneratorModel& model, int level, Size size, std::span<const float> shares);

  /// Where to put the coarser picture, made larger, and behind it the noise.
  ChannelPlanes& input() { return input_; }
  /// What the network adds, `channels` of the picture.
  const ChannelPlanes& run(PixelShares shares = {});

 private:
  struct Layer {
    dnnl::convolution_forward convolution;
    dnnl::memory weights, bias, scratchpad;
  };
  Layer make_layer(const PlainLayer& given, bool activated, bool residual);
  void execute(const Layer& layer, const ChannelPlanes& from, const ChannelPlanes& to,
               const ChannelPlanes* added);
  void activate(int layer, const ChannelPlanes& values, const ChannelPlanes* added,
                PixelShares shares) const;
  void shift_output(PixelShares shares) const;

  const GeneratorModel& model_;
  int level_;
  bool mixed_;
  Size size_;
  dnnl::engine engine_;
  dnnl::stream stream_;
  std::vector<Layer> layers_;
  ChannelPlanes input_, output_;
  ChannelPlanes hidden_[2];
};

}  // namespace gramloom
