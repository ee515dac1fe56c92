#pragma once

#include <vector>

#include "core/image.h"

namespace gramloom {

/// Principal axes of an image's colours, for work in channels that are not correlated (Heeger &
/// Bergen 1995, section 3.5): w = (A (x − mean)) / deviation, x = mean + Aᵀ (deviation · w).
struct ColourPca {
  int channels = 0;
  std::vector<float> mean;       // of each channel
  std::vector<float> axes;       // A, channels × channels, row-major: row i is the unit axis i,
                                 // its largest component positive; by falling deviation
  std::vector<float> deviation;  // standard deviation along each axis; 0 where the colours are flat

  friend bool operator==(const ColourPca&, const ColourPca&) = default;
};

/// Of the image's pixels. An axis is flat when its deviation is below 1e-6 of the image's largest
/// magnitude, which is what rounding to float alone can make. Throws Error when the image is empty.
ColourPca colour_pca(const Image& image);

/// The root of the sum of the variances along all axes.
double total_deviation(const ColourPca& pca);

/// `scale` times the colours along the first axes, less the mean: an image of `channels` channels,
/// of which those beyond the image's own stay 0. Throws Error when the numbers of channels differ.
Image along_axes(const Image& image, const ColourPca& pca, double scale, int axes, int channels);

/// Colours along the axes, each of mean 0 and variance 1 on the image that `pca` was taken from.
/// Along a flat axis the result is 0. Throws Error when the numbers of channels differ.
Image whitened(const Image& image, const ColourPca& pca);

/// The inverse: exact up to rounding for colours of the image that `pca` was taken from. Whatever
/// lies along a flat axis is dropped. Throws Error when the numbers of channels differ.
Image unwhitened(const Image& image, const ColourPca& pca);

}  // namespace gramloom
