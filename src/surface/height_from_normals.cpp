#include "surface/height_from_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "signal/fourier.h"

namespace gramloom {

namespace {

constexpr float least_z = 0.01f;

struct Slopes {
  cv::Mat x, y;  // along columns to the right and rows downwards, pixels of height a pixel
};

Slopes slopes_of(const Image& normals) {
  Slopes slopes{cv::Mat(normals.height, normals.width, CV_32F),
                cv::Mat(normals.height, normals.width, CV_32F)};
  for (int y = 0; y < normals.height; ++y)
    for (int x = 0; x < normals.width; ++x) {
      const float* n = normals.at(x, y);
      const float z = std::max(n[2], least_z);
      slopes.x.at<float>(y, x) = -n[0] / z;
      slopes.y.at<float>(y, x) = n[1] / z;
    }
  return slopes;
}

// Mirrors a field beyond its last column, and the slope across the mirror changes its sign. There a
// height is beside its own copy, so that its central difference is half of the one-sided slope.
cv::Mat mirrored_columns(const cv::Mat& field, bool across) {
  cv::Mat half = field.clone();
  if (across) {
    half.col(0) *= 0.5f;
    half.col(half.cols - 1) *= 0.5f;
  }
  cv::Mat mirror;
  cv::flip(half, mirror, 1);
  if (across) mirror = -mirror;
  cv::Mat both;
  cv::hconcat(half, mirror, both);
  return both;
}

cv::Mat mirrored_rows(const cv::Mat& field, bool across) {
  return mirrored_columns(field.t(), across).t();
}

// The transfer function of the slope along an axis, less its factor i.
double transfer(int k, int count) {
  const int signed_k = 2 * k > count ? k - count : k;
  const double omega = 2 * std::numbers::pi * signed_k / count;
  if (2 * k == count) return 0;  // the highest frequency has no odd part
  if (std::abs(omega) <= std::numbers::pi / 2) return std::sin(omega);
  return omega * 2 / std::numbers::pi;
}

cv::Mat integrate(const cv::Mat& slope_x, const cv::Mat& slope_y) {
  cv::Mat coefficients = fourier_coefficients(slope_x);
  const cv::Mat down = fourier_coefficients(slope_y);
  const Complex i(0, 1);
  for (int l = 0; l < coefficients.rows; ++l)
    for (int k = 0; k <= coefficients.cols / 2; ++k) {
      const double a = transfer(k, coefficients.cols), b = transfer(l, coefficients.rows);
      const double power = a * a + b * b;
      Complex& c = coefficients.at<Complex>(l, k);
      const Complex sum =
          static_cast<float>(a) * c + static_cast<float>(b) * down.at<Complex>(l, k);
      c = power > 0 ? times(-i, sum) / static_cast<float>(power) : Complex(0);
    }
  return from_fourier_coefficients(coefficients);
}

}  // namespace

Image height_from_normals(const Image& normals, double strength, Tile wraps) {
  if (normals.channels != 3)
    throw Error("normals have {} channels, allowed are 3", normals.channels);
  if (!(strength > 0)) throw Error("strength = {}: allowed are numbers above 0", strength);
  Slopes slopes = slopes_of(normals);
  if (!tiles_x(wraps))
    slopes = {mirrored_columns(slopes.x, true), mirrored_columns(slopes.y, false)};
  if (!tiles_y(wraps)) slopes = {mirrored_rows(slopes.x, false), mirrored_rows(slopes.y, true)};
  const cv::Mat whole = integrate(slopes.x, slopes.y);
  const cv::Mat own = whole(cv::Rect(0, 0, normals.width, normals.height));
  double lowest = 0;
  cv::minMaxLoc(own, &lowest);
  Image height(normals.size(), 1);
  for (int y = 0; y < normals.height; ++y)
    for (int x = 0; x < normals.width; ++x)
      *height.at(x, y) =
          static_cast<float>((static_cast<double>(own.at<float>(y, x)) - lowest) / strength);
  return height;
}

}  // namespace gramloom
