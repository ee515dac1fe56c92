#pragma once

#include "core/image.h"

namespace gramloom::neural {

/// Deviations of an exemplar's bands, channel by channel: differences of Gaussian blurs of 0, 1, 2,
/// 4 and 8 pixels, and what remains, with its mean.
struct BandStatistics {
  std::vector<std::vector<float>> deviation;  // of each band, then of the rest; each per channel
  std::vector<float> mean;                    // of the rest
};
/// Only bands that a picture of size `picture` has, too. Of the pixels that may be used alone;
/// usable empty: of all.
BandStatistics band_statistics(const Image& image, Tile wraps, Size picture,
                               const Image& usable = {});

/// Gives each band of an image that wraps the exemplar's deviation; a factor is at least ½ and at
/// most 3.
void match_bands(Image& image, const BandStatistics& exemplar);
/// The same of the pixels alone that `made` (guidance.h) says are made; what is coarser than bands
/// stays.
void match_bands(Image& image, const BandStatistics& exemplar, const Image& made);

}  // namespace gramloom::neural
