#include "signal/correlation.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/threads.h"
#include "signal/fourier.h"

namespace gramloom {

namespace {

/// An overlap with less than this part of an image's mean energy a pixel counts as flat.
constexpr double flat_part = 1e-3;

/// As the further components of a grey picture are.
bool is_empty(const Image& image, int channel) {
  for (std::size_t i = static_cast<std::size_t>(channel); i < image.pixels.size();
       i += static_cast<std::size_t>(image.channels))
    if (image.pixels[i] != 0) return false;
  return true;
}

/// The channel less its mean.
cv::Mat centred_plane(const Image& image, int channel) {
  cv::Mat plane = channel_plane(image, channel);
  plane -= cv::mean(plane)[0];
  return plane;
}

/// Sums of squares over all channels: entry (y, x) covers the pixels above and to the left.
cv::Mat1d energy_integral(const Image& image) {
  cv::Mat squares = cv::Mat::zeros(image.height, image.width, CV_32F);
  for (int c = 0; c < image.channels; ++c) {
    const cv::Mat plane = centred_plane(image, c);
    squares += plane.mul(plane);
  }
  cv::Mat1d integral;
  cv::integral(squares, integral, CV_64F);
  return integral;
}

double sum_over(const cv::Mat1d& integral, int left, int top, int width, int height) {
  return integral(top + height, left + width) - integral(top, left + width) -
         integral(top + height, left) + integral(top, left);
}

/// Σ a(p + s) b(p) over all channels; shift s is at s modulo the size.
cv::Mat1f products(const Image& a, const Image& b, cv::Size padded) {
  cv::Mat sum = cv::Mat::zeros(padded, CV_32F);
  const auto transformed = [&](const Image& image, int channel) {
    cv::Mat plane = cv::Mat::zeros(padded, CV_32F);
    centred_plane(image, channel).copyTo(plane({0, 0, image.width, image.height}));
    cv::dft(plane, plane, 0, image.height);
    return plane;
  };
  for (int c = 0; c < a.channels; ++c) {
    if (is_empty(a, c)) continue;
    cv::Mat product = transformed(a, c);
    cv::mulSpectrums(product, &a == &b ? product.clone() : transformed(b, c), product, 0, true);
    sum += product;
  }
  cv::idft(sum, sum, cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
  return sum;
}

}  // namespace

ShiftCorrelation shift_correlation(const Image& a, const Image& b) {
  const cv::Size padded{fast_length_up(a.width + b.width - 1),
                        fast_length_up(a.height + b.height - 1)};
  const cv::Mat1f product = products(a, b, padded);
  const cv::Mat1d energy_a = energy_integral(a), energy_b = energy_integral(b);
  const double area_a = double(a.width) * a.height, area_b = double(b.width) * b.height;
  const double flat_a = flat_part * energy_a(a.height, a.width) / area_a;
  const double flat_b = flat_part * energy_b(b.height, b.width) / area_b;
  ShiftCorrelation result{cv::Mat1f(a.height + b.height - 1, a.width + b.width - 1, 0.0f),
                          1 - b.width, 1 - b.height};
  parallel_for(result.values.rows, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto row = static_cast<int>(begin); row < end; ++row) {
      const int dy = row + result.top;
      const int height = std::min(a.height, b.height + dy) - std::max(0, dy);
      for (int column = 0; column < result.values.cols; ++column) {
        const int dx = column + result.left;
        const int width = std::min(a.width, b.width + dx) - std::max(0, dx);
        const double area = double(width) * height;
        if (4 * area < std::min(area_a, area_b)) continue;
        const double of_a = sum_over(energy_a, std::max(0, dx), std::max(0, dy), width, height);
        const double of_b = sum_over(energy_b, std::max(0, -dx), std::max(0, -dy), width, height);
        if (of_a <= flat_a * area || of_b <= flat_b * area) continue;
        const float ab =
            product((dy + padded.height) % padded.height, (dx + padded.width) % padded.width);
        result.values(row, column) =
            static_cast<float>(std::clamp(double{ab} / std::sqrt(of_a * of_b), -1.0, 1.0));
      }
    }
  });
  return result;
}

double strongest_correlation(const ShiftCorrelation& correlation) {
  float best = 0;
  for (const float value : correlation.values) best = std::max(best, value);
  return double{best};
}

double autocorrelation_distance(const ShiftCorrelation& exemplar, Size exemplar_size,
                                const ShiftCorrelation& image, Size image_size) {
  const int most_x = std::min(exemplar_size.width, image_size.width) / 4;
  const int most_y = std::min(exemplar_size.height, image_size.height) / 4;
  double sum = 0;
  for (int dy = 0; dy <= most_y; ++dy)
    for (int dx = -most_x; dx <= most_x; ++dx) {
      const double difference = double{exemplar.at(dx, dy)} - double{image.at(dx, dy)};
      sum += difference * difference;
    }
  return std::sqrt(sum / ((2.0 * most_x + 1) * (most_y + 1.0)));
}

double repetition(const ShiftCorrelation& self, int side) {
  const int near = side / 8;
  float best = 0;
  for (int row = 0; row < self.values.rows; ++row)
    for (int column = 0; column < self.values.cols; ++column)
      if (std::abs(column + self.left) > near || std::abs(row + self.top) > near)
        best = std::max(best, self.values(row, column));
  return double{best};
}

}  // namespace gramloom
