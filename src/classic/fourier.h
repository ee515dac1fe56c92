#pragma once

#include <opencv2/core.hpp>

#include "core/image.h"

namespace gramloom {

// Discrete Fourier transforms of one channel at a time, by OpenCV: single-threaded, so that the
// bytes do not depend on threads; run channels in parallel. For this folder's own use.

/// One channel of an image as a CV_32F matrix, cropped to `size` at the top left.
cv::Mat channel_plane(const Image& image, int channel, Size size);
/// Writes the top left of `plane`, which is at least as large as the image, into a channel.
void set_channel(Image& image, int channel, const cv::Mat& plane);

/// Fourier coefficients of a real plane, c(k, l) = 1/(WH) Σ u(x, y) exp(−2πi (kx/W + ly/H)), as a
/// CV_32FC2 matrix of the plane's size. With this scale they describe the same function on grids
/// of any size. Only columns 0 to W/2 count; the rest is their mirror image.
cv::Mat fourier_coefficients(const cv::Mat& plane);
/// The inverse; it reads columns 0 to W/2 only.
cv::Mat from_fourier_coefficients(const cv::Mat& coefficients);

/// Coefficients of the periodic component of a plane: the plane less the smooth image that takes
/// up the jumps between its opposite edges, which would otherwise draw a cross in the spectrum.
/// Moisan 2011, "Periodic plus smooth image decomposition", equation 11; same mean as the plane.
cv::Mat periodic_coefficients(const cv::Mat& plane);

/// The nearest length from `length` up whose transform is fast (2ᵃ 3ᵇ 5ᶜ).
int fast_length_up(int length);
/// The nearest length from `length` down without a prime factor above 31: transforms slow down in
/// proportion to it. Up to 32 every length will do.
int fast_length_down(int length);

/// How a plane of the target's size is made of periodic ones, on one axis: the part of the exemplar
/// that is analysed, and the period that is synthesised (and cropped where it need not tile).
struct AxisPlan {
  int analysed = 0;  // ≤ the exemplar's length
  int period = 0;    // = the target's length where it tiles, ≥ it elsewhere
};
AxisPlan plan_axis(int exemplar, int target, bool tile);

}  // namespace gramloom
