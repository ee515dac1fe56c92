#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"

namespace gramloom::neural {

/// Deviations of an exemplar's bands, channel by channel: differences of Gaussian blurs of 0, 1, 2,
/// 4 and 8 pixels, and what remains, with its mean.
struct BandStatistics {
  std::vector<std::vector<float>> deviation;  // of each band, then of the rest; each per channel
  std::vector<float> mean;                    // of the rest
  std::int64_t pixels = 0;
};

/// Which region each pixel of a picture is of, row by row; −1: of none. Empty: all are of one.
struct Regions {
  int count = 1;
  std::vector<std::int32_t> region;
};

/// Only bands that a picture of size `picture` has, too.
BandStatistics band_statistics(const Image& image, Tile wraps, Size picture);
/// Of each region.
std::vector<BandStatistics> band_statistics(const Image& image, Tile wraps, Size picture,
                                            const Regions& regions);

/// Gives each band of an image that wraps the exemplar's deviation; a factor is at least ½ and at
/// most 3.
void match_bands(Image& image, const BandStatistics& exemplar);
/// Of each region that of the exemplar's region, where both have a few dozen pixels; what is in
/// none stays. `rest`: whether what is coarser than the bands is matched too.
void match_bands(Image& image, const std::vector<BandStatistics>& exemplar, const Regions& regions,
                 bool rest);

}  // namespace gramloom::neural
