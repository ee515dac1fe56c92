#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/random.h"

namespace gramloom {

/// A few colours that stand for all of an image's.
struct Palette {
  int channels = 0;
  std::vector<float> colours;  // size() × channels

  int size() const { return static_cast<int>(colours.size()) / channels; }
};

/// At most `colours` (1 to 255) colours by k-means (Lloyd 1982) from a random start spread out as
/// in Arthur & Vassilvitskii 2007, "k-means++". An image of no more distinct colours gets exactly
/// these. Learnt from at most 16384 of the pixels, drawn at random.
Palette learn_palette(const Image& image, int colours, Random random);

/// The index of the palette's nearest colour for each pixel; of equally near ones the first.
std::vector<std::uint8_t> nearest_colours(const Image& image, const Palette& palette);

}  // namespace gramloom
