#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/image.h"
#include "signal/fourier.h"

namespace gramloom {

/// The steerable pyramid: a high-pass residual, oriented bands at octaves apart, and a low-pass
/// residual. Simoncelli & Freeman 1995, "The steerable pyramid: a flexible architecture for
/// multi-scale derivative computation"; filters in the frequency domain as in Portilla &
/// Simoncelli 2000, section 2.2. With r in radians a pixel and low(c) = 1 up to c/2, cos(π/2
/// log₂(2r/c)) up to c, 0 above, high(c)² = 1 − low(c)²:
///   high-pass high(π); band s, q: low(π/2ˢ) high(π/2ˢ⁺¹) a cosᴼ⁻¹(θ − πq/O); low-pass low(π/2ᴸ).
/// Their squares add up to 1, so applying each filter a second time and adding up gives the image
/// back. For this folder's own use.
///
/// A departure that makes any size work: level s is sampled on a grid of at least 1/2ˢ of the side
/// (the next fast length) rather than half of the previous one. Frequencies are those of the full
/// image, so nothing is aliased, and odd sizes reconstruct as exactly as powers of two.
struct PyramidBand {
  Size grid;            // of its samples
  cv::Mat gain;         // CV_32F: of frequencies 0 to grid.width/2 by all rows
  Complex phase{1, 0};  // makes the filter's response real
};

struct SteerablePyramid {
  std::vector<PyramidBand> bands;  // high-pass, level 0's orientations, level 1's, …, low-pass
};

/// levels ≥ 1, orientations ≥ 1.
SteerablePyramid steerable_pyramid(Size size, int levels, int orientations);

/// Samples of a band of the image with these Fourier coefficients (see fourier.h).
cv::Mat band_of(const cv::Mat& coefficients, const PyramidBand& band);

/// Adds to an image's coefficients what a band with these coefficients (on its own grid)
/// contributes.
void add_band(cv::Mat& coefficients, const cv::Mat& band_coefficients, const PyramidBand& band);

}  // namespace gramloom
