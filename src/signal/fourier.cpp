#include "signal/fourier.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace gramloom {

namespace {

/// OpenCV's transform of n values takes a time in proportion to n and to n's prime factors.
bool is_slow(int length) {
  int rest = length;
  for (int p = 2; p <= 31; ++p)
    while (rest % p == 0) rest /= p;
  return rest > 1;
}

/// exp(−iπ k²/n) for k = 0 … n − 1.
std::vector<Complex> chirp(int n) {
  std::vector<Complex> values;
  for (std::int64_t k = 0; k < n; ++k)
    values.emplace_back(
        std::polar(1.0, -std::numbers::pi * static_cast<double>(k * k % (2 * n)) / n));
  return values;
}

/// Bluestein's transform of each row: kx = (k² + x² − (k − x)²)/2 makes of the sum over x a
/// convolution with a chirp, which transforms of any larger length do.
cv::Mat slow_dft_of_rows(const cv::Mat& rows) {
  const int n = rows.cols, padded = fast_length_up(2 * n - 1);
  const auto turn = chirp(n);
  cv::Mat kernel = cv::Mat::zeros(1, padded, CV_32FC2);
  for (int k = 0; k < n; ++k)
    kernel.at<Complex>(k) = kernel.at<Complex>((padded - k) % padded) =
        std::conj(turn[static_cast<std::size_t>(k)]);
  cv::dft(kernel, kernel, cv::DFT_SCALE);
  cv::Mat work = cv::Mat::zeros(rows.rows, padded, CV_32FC2), result(rows.size(), CV_32FC2);
  for (int y = 0; y < rows.rows; ++y)
    for (int x = 0; x < n; ++x)
      work.at<Complex>(y, x) = times(rows.at<Complex>(y, x), turn[static_cast<std::size_t>(x)]);
  cv::dft(work, work, cv::DFT_ROWS);
  for (int y = 0; y < rows.rows; ++y)
    for (int x = 0; x < padded; ++x)
      work.at<Complex>(y, x) = times(work.at<Complex>(y, x), kernel.at<Complex>(x));
  cv::dft(work, work, cv::DFT_ROWS | cv::DFT_INVERSE);
  for (int y = 0; y < rows.rows; ++y)
    for (int x = 0; x < n; ++x)
      result.at<Complex>(y, x) = times(work.at<Complex>(y, x), turn[static_cast<std::size_t>(x)]);
  return result;
}

cv::Mat dft_of_rows(const cv::Mat& rows) {
  if (is_slow(rows.cols)) return slow_dft_of_rows(rows);
  cv::Mat result;
  cv::dft(rows, result, cv::DFT_ROWS);
  return result;
}

/// Transform of a complex matrix of any size.
cv::Mat dft_of_any_size(const cv::Mat& values) { return dft_of_rows(dft_of_rows(values).t()).t(); }

/// The conjugates of all coefficients, from those of columns 0 to width/2.
cv::Mat full_conjugate(const cv::Mat& half) {
  cv::Mat full(half.size(), CV_32FC2);
  for (int y = 0; y < half.rows; ++y)
    for (int x = 0; x < half.cols; ++x)
      full.at<Complex>(y, x) = x <= half.cols / 2
                                   ? std::conj(half.at<Complex>(y, x))
                                   : half.at<Complex>((half.rows - y) % half.rows, half.cols - x);
  return full;
}

}  // namespace

cv::Mat channel_plane(const Image& image, int channel) {
  cv::Mat plane(image.height, image.width, CV_32F);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) plane.at<float>(y, x) = image.at(x, y)[channel];
  return plane;
}

void set_channel(Image& image, int channel, const cv::Mat& plane) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.at(x, y)[channel] = plane.at<float>(y, x);
}

cv::Mat fourier_coefficients(const cv::Mat& plane) { return fourier_coefficients(plane.clone()); }

cv::Mat fourier_coefficients(cv::Mat&& plane) {
  // The mean is often far larger than all other coefficients and would drown them in rounding.
  const auto mean = static_cast<float>(cv::mean(plane)[0]);
  plane -= mean;
  cv::Mat coefficients;
  if (is_slow(plane.cols) || is_slow(plane.rows)) {
    const cv::Mat parts[] = {plane, cv::Mat::zeros(plane.size(), CV_32F)};
    cv::merge(parts, 2, coefficients);
    coefficients = dft_of_any_size(coefficients) / static_cast<double>(plane.total());
  } else {
    cv::dft(plane, coefficients, cv::DFT_COMPLEX_OUTPUT | cv::DFT_SCALE);
  }
  plane.release();
  coefficients.at<Complex>(0, 0) += mean;
  return coefficients;
}

cv::Mat from_fourier_coefficients(const cv::Mat& coefficients) {
  cv::Mat plane;
  if (is_slow(coefficients.cols) || is_slow(coefficients.rows))
    cv::extractChannel(dft_of_any_size(full_conjugate(coefficients)), plane, 0);
  else
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
    auto* out = coefficients.ptr<Complex>(y);
    const auto v = static_cast<std::size_t>(y);
    for (int x = y == 0 ? 1 : 0; x <= width / 2; ++x) {
      const auto u = static_cast<std::size_t>(x);
      const std::complex<double> edges =
          columns[v] * (1.0 - turn_x[u]) + rows[u] * (1.0 - turn_y[v]);
      const double laplacian = 2 * turn_x[u].real() + 2 * turn_y[v].real() - 4;
      out[x] -= Complex(edges * (scale / laplacian));
    }
  }
  return coefficients;
}

int fast_length_up(int length) { return cv::getOptimalDFTSize(length); }

int period_for(int exemplar, int target, bool tile) {
  if (tile) return target;
  return target <= exemplar ? exemplar : fast_length_up(target);
}

}  // namespace gramloom
