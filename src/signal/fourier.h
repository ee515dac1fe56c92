#pragma once

#include <complex>
#include <opencv2/core.hpp>

#include "core/image.h"

namespace gramloom {

// Discrete Fourier transforms of one channel at a time, by OpenCV: single-threaded, so that the
// bytes do not depend on threads; run channels in parallel. For this folder's own use.

using Complex = std::complex<float>;

/// a·b for finite numbers: the operator's care for infinities costs several times as much.
inline Complex times(Complex a, Complex b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// One channel of an image as a CV_32F matrix.
cv::Mat channel_plane(const Image& image, int channel);
/// Writes the top left of `plane`, which is at least as large as the image, into a channel.
void set_channel(Image& image, int channel, const cv::Mat& plane);

/// Fourier coefficients of a real plane, c(k, l) = 1/(WH) Σ u(x, y) exp(−2πi (kx/W + ly/H)), as a
/// CV_32FC2 matrix of the plane's size. With this scale they describe the same function on grids
/// of any size. Only columns 0 to W/2 count; the rest is their mirror image. Any size will do:
/// lengths with a large prime factor are transformed as in Bluestein 1970, "A linear filtering
/// approach to the computation of discrete Fourier transform".
/// A plane that is handed over is used up.
cv::Mat fourier_coefficients(const cv::Mat& plane);
cv::Mat fourier_coefficients(cv::Mat&& plane);
/// The inverse; it reads columns 0 to W/2 only.
cv::Mat from_fourier_coefficients(const cv::Mat& coefficients);

/// Coefficients of the periodic component of a plane: the plane less the smooth image that takes
/// up the jumps between its opposite edges, which would otherwise draw a cross in the spectrum.
/// Moisan 2011, "Periodic plus smooth image decomposition", equation 11; same mean as the plane.
cv::Mat periodic_coefficients(const cv::Mat& plane);

/// The nearest length from `length` up whose transform is fast (2ᵃ 3ᵇ 5ᶜ).
int fast_length_up(int length);

/// The length of the periodic image to make, on one axis: the target's where it must tile, else
/// one to crop it from, the exemplar's if that is enough.
int period_for(int exemplar, int target, bool tile);

}  // namespace gramloom
