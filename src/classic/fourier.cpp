#include "classic/fourier.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace gramloom {

cv::Mat channel_plane(const Image& image, int channel, Size size) {
  cv::Mat plane(size.height, size.width, CV_32F);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) plane.at<float>(y, x) = image.at(x, y)[channel];
  return plane;
}

void set_channel(Image& image, int channel, const cv::Mat& plane) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.at(x, y)[channel] = plane.at<float>(y, x);
}

cv::Mat fourier_coefficients(const cv::Mat& plane) {
  // The mean is often far larger than all other coefficients and would drown them in rounding.
  const auto mean = static_cast<float>(cv::mean(plane)[0]);
  cv::Mat coefficients;
  cv::dft(plane - mean, coefficients, cv::DFT_COMPLEX_OUTPUT | cv::DFT_SCALE);
  coefficients.at<std::complex<float>>(0, 0) += mean;
  return coefficients;
}

cv::Mat from_fourier_coefficients(const cv::Mat& coefficients) {
  cv::Mat plane;
  cv::dft(coefficients, plane, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT);
  return plane;
}

namespace {

using Spectrum = std::vector<std::complex<double>>;

/// Transform of the jump between two opposite edges.
Spectrum jump_spectrum(const cv::Mat& last, const cv::Mat& first) {
  const cv::Mat jump = cv::Mat(last - first).reshape(1, 1);
  cv::Mat wide, spectrum;
  jump.convertTo(wide, CV_64F);
  cv::dft(wide, spectrum, cv::DFT_COMPLEX_OUTPUT);
  return {spectrum.ptr<std::complex<double>>(), spectrum.ptr<std::complex<double>>() + jump.cols};
}

/// exp(2πi k/n) for k = 0 … n − 1.
Spectrum roots_of_one(int n) {
  Spectrum roots;
  for (int k = 0; k < n; ++k) roots.push_back(std::polar(1.0, 2 * std::numbers::pi * k / n));
  return roots;
}

}  // namespace

cv::Mat periodic_coefficients(const cv::Mat& plane) {
  const int width = plane.cols, height = plane.rows;
  cv::Mat coefficients = fourier_coefficients(plane);
  // The edge image is the jump on the first column (row) and its opposite on the last, so its
  // transform follows from those of the jumps alone.
  const Spectrum columns = jump_spectrum(plane.col(width - 1).clone(), plane.col(0).clone());
  const Spectrum rows = jump_spectrum(plane.row(height - 1), plane.row(0));
  const Spectrum turn_x = roots_of_one(width), turn_y = roots_of_one(height);
  const double scale = 1.0 / (static_cast<double>(width) * height);
  for (int y = 0; y < height; ++y) {
    auto* out = coefficients.ptr<std::complex<float>>(y);
    const auto v = static_cast<std::size_t>(y);
    for (int x = y == 0 ? 1 : 0; x <= width / 2; ++x) {
      const auto u = static_cast<std::size_t>(x);
      const std::complex<double> edges =
          columns[v] * (1.0 - turn_x[u]) + rows[u] * (1.0 - turn_y[v]);
      const double laplacian = 2 * turn_x[u].real() + 2 * turn_y[v].real() - 4;
      out[x] -= std::complex<float>(edges * (scale / laplacian));
    }
  }
  return coefficients;
}

int fast_length_up(int length) { return cv::getOptimalDFTSize(length); }

int fast_length_down(int length) {
  const auto largest_prime_factor = [](int n) {
    int largest = 1;
    for (int p = 2; n > 1; ++p)
      for (; n % p == 0; n /= p) largest = p;
    return largest;
  };
  while (largest_prime_factor(length) > 31) --length;
  return length;
}

AxisPlan plan_axis(int exemplar, int target, bool tile) {
  const int analysed = fast_length_down(exemplar);
  if (tile) return {analysed, target};
  return {analysed, target <= analysed ? analysed : fast_length_up(target)};
}

}  // namespace gramloom
