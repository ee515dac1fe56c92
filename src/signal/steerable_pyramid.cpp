#include "signal/steerable_pyramid.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "core/threads.h"
#include "signal/fourier.h"

namespace gramloom {

namespace {

using std::numbers::pi;

double low(double r, double cutoff) {
  if (r <= cutoff / 2) return 1;
  if (r >= cutoff) return 0;
  return std::cos(pi / 2 * std::log2(2 * r / cutoff));
}

double high(double r, double cutoff) {
  if (r <= cutoff / 2) return 0;
  if (r >= cutoff) return 1;
  return std::sin(pi / 2 * std::log2(2 * r / cutoff));
}

/// a in a² Σ_q cos²⁽ᴼ⁻¹⁾(θ − πq/O) = 1.
double angular_scale(int orientations) {
  double mean_power = 1;  // of cos² to the power O − 1
  for (int k = 1; k < orientations; ++k) mean_power *= (2.0 * k - 1) / (2.0 * k);
  return 1 / std::sqrt(orientations * mean_power);
}

double power(double base, int exponent) {
  double result = 1;
  for (int k = 0; k < exponent; ++k) result *= base;
  return result;
}

/// Signed frequency of a row of a spectrum of `length` rows, and back.
int frequency(int row, int length) { return row <= length / 2 ? row : row - length; }
int row_of(int frequency, int length) { return frequency < 0 ? frequency + length : frequency; }

/// A fast length for samples of frequencies below length/2ˢ⁺¹.
int grid_side(int length, int level) {
  return fast_length_up((length + (1 << level) - 1) >> level);
}

PyramidBand make_band(Size size, Size grid, Complex phase,
                      const std::function<double(double r, double angle)>& gain) {
  PyramidBand band{grid, {}, phase};
  band.gain.create(band.grid.height, band.grid.width / 2 + 1, CV_32F);
  for (int y = 0; y < band.gain.rows; ++y)
    for (int x = 0; x < band.gain.cols; ++x) {
      const double u = 2 * pi * x / size.width;
      const double v = 2 * pi * frequency(y, band.grid.height) / size.height;
      band.gain.at<float>(y, x) =
          static_cast<float>(gain(std::sqrt(u * u + v * v), std::atan2(v, u)));
    }
  return band;
}

/// Calls f(row of the band, the image's row of the same frequency, columns that both have). A
/// band's grid may reach a little beyond the image's frequencies, as its sides are fast lengths;
/// its gain is 0 there, and the image has nothing to read.
template <class F>
void for_common_rows(const PyramidBand& band, const cv::Mat& coefficients, const F& f) {
  const int columns = std::min(band.gain.cols, coefficients.cols);
  for (int y = 0; y < band.grid.height; ++y) {
    const int of_row = frequency(y, band.grid.height);
    if (2 * std::abs(of_row) <= coefficients.rows) f(y, row_of(of_row, coefficients.rows), columns);
  }
}

}  // namespace

SteerablePyramid steerable_pyramid(Size size, int levels, int orientations) {
  const double scale = angular_scale(orientations);
  // cosᴼ⁻¹ is odd when O is even: i makes its response real.
  const Complex phase = orientations % 2 == 0 ? Complex(0, 1) : Complex(1, 0);
  SteerablePyramid pyramid;
  pyramid.bands.resize(static_cast<std::size_t>(levels * orientations + 2));
  const int last = levels * orientations + 1;
  const auto make = [&](int index) {
    if (index == 0) return make_band(size, size, 1, [](double r, double) { return high(r, pi); });
    const int level = (index - 1) / orientations;
    const Size grid{grid_side(size.width, level), grid_side(size.height, level)};
    const double cutoff = pi / std::exp2(level);
    if (index == last)
      return make_band(size, grid, 1, [&](double r, double) { return low(r, cutoff); });
    const double axis = pi * ((index - 1) % orientations) / orientations;
    return make_band(size, grid, phase, [&](double r, double angle) {
      const double radial = low(r, cutoff) * high(r, cutoff / 2);
      return radial > 0 ? radial * scale * power(std::cos(angle - axis), orientations - 1) : 0;
    });
  };
  parallel_for(last + 1, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<int>(begin); i < end; ++i)
      pyramid.bands[static_cast<std::size_t>(i)] = make(i);
  });
  return pyramid;
}

cv::Mat band_of(const cv::Mat& coefficients, const PyramidBand& band) {
  cv::Mat filtered(band.grid.height, band.grid.width, CV_32FC2, cv::Scalar::all(0));
  for_common_rows(band, coefficients, [&](int y, int image_row, int columns) {
    const auto* in = coefficients.ptr<Complex>(image_row);
    const auto* gain = band.gain.ptr<float>(y);
    auto* out = filtered.ptr<Complex>(y);
    for (int x = 0; x < columns; ++x) out[x] = gain[x] * times(in[x], band.phase);
  });
  return from_fourier_coefficients(filtered);
}

void add_band(cv::Mat& coefficients, const cv::Mat& band_coefficients, const PyramidBand& band) {
  for_common_rows(band, coefficients, [&](int y, int image_row, int columns) {
    const auto* in = band_coefficients.ptr<Complex>(y);
    const auto* gain = band.gain.ptr<float>(y);
    auto* out = coefficients.ptr<Complex>(image_row);
    for (int x = 0; x < columns; ++x) out[x] += gain[x] * times(in[x], std::conj(band.phase));
  });
}

}  // namespace gramloom
