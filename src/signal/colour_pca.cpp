#include "signal/colour_pca.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>

#include "core/error.h"
#include "core/portable_math.h"
#include "core/threads.h"

namespace gramloom {

namespace {

constexpr std::int64_t grain = 8192;  // pixels

/// The sum over all pixels of what `add` adds to an array of `count`. The order of the additions
/// depends on the image alone.
std::vector<double> sum_over_pixels(const Image& image, std::size_t count,
                                    const std::function<void(const float*, double*)>& add) {
  const auto pixels = static_cast<std::int64_t>(pixel_count(image.size()));
  const auto chunks = static_cast<std::size_t>((pixels + grain - 1) / grain);
  std::vector<double> partial(chunks * count);
  parallel_for(pixels, grain, [&](std::int64_t begin, std::int64_t end) {
    double* sum = partial.data() + static_cast<std::size_t>(begin / grain) * count;
    for (auto i = begin; i < end; ++i) add(image.pixels.data() + i * image.channels, sum);
  });
  std::vector<double> total(count);
  for (std::size_t i = 0; i < partial.size(); ++i) total[i % count] += partial[i];
  return total;
}

struct Eigen {
  std::vector<double> values;   // falling
  std::vector<double> vectors;  // rows
};

/// Eigenvalues and unit eigenvectors of a symmetric n×n matrix by cyclic Jacobi rotations (Jacobi
/// 1846): for n ≤ 64 quick, accurate, and the same bytes everywhere.
Eigen symmetric_eigen(std::vector<double> a, std::size_t n) {
  std::vector<double> v(n * n);
  for (std::size_t i = 0; i < n; ++i) v[i * n + i] = 1;
  const auto rotate = [](double& x, double& y, double c, double s) {
    const double old = x;
    x = c * old - s * y;
    y = s * old + c * y;
  };
  for (int sweep = 0; sweep < 64; ++sweep) {
    bool done = true;
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        const double apq = a[p * n + q];
        // a_pq² ≤ (1e-17)² a_pp a_qq is rounding; zero when a row of the matrix is.
        if (apq * apq <= 1e-34 * std::abs(a[p * n + p] * a[q * n + q]) || apq == 0) continue;
        done = false;
        const double theta = (a[q * n + q] - a[p * n + p]) / (2 * apq);
        const double t =
            (theta < 0 ? -1 : 1) / (std::abs(theta) + portable::sqrt(theta * theta + 1));
        const double c = 1 / portable::sqrt(t * t + 1);
        const double s = t * c;
        for (std::size_t k = 0; k < n; ++k) rotate(a[k * n + p], a[k * n + q], c, s);
        for (std::size_t k = 0; k < n; ++k) rotate(a[p * n + k], a[q * n + k], c, s);
        for (std::size_t k = 0; k < n; ++k) rotate(v[p * n + k], v[q * n + k], c, s);
        a[p * n + q] = a[q * n + p] = 0;
      }
    if (done) break;
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return a[i * n + i] > a[j * n + j]; });
  Eigen eigen;
  for (const std::size_t i : order) {
    eigen.values.push_back(a[i * n + i]);
    eigen.vectors.insert(eigen.vectors.end(), v.begin() + static_cast<std::ptrdiff_t>(i * n),
                         v.begin() + static_cast<std::ptrdiff_t>((i + 1) * n));
  }
  return eigen;
}

/// Of v and −v, the one whose largest component is positive.
void fix_sign(std::span<float> axis) {
  const auto largest = std::max_element(axis.begin(), axis.end(),
                                        [](float x, float y) { return std::abs(x) < std::abs(y); });
  if (*largest < 0)
    for (float& x : axis) x = -x;
}

/// offset_out + M (x − offset_in) for each pixel x.
Image transformed(const Image& image, const std::vector<float>& offset_in,
                  const std::vector<float>& matrix, const std::vector<float>& offset_out) {
  const auto channels = static_cast<std::size_t>(image.channels);
  if (offset_in.size() != channels)
    throw Error("an image of {} channels does not fit principal axes of {}", image.channels,
                offset_in.size());
  Image result(image.size(), image.channels);
  const auto pixels = static_cast<std::int64_t>(pixel_count(image.size()));
  parallel_for(pixels, grain, [&](std::int64_t begin, std::int64_t end) {
    std::vector<float> centred(channels);
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const float* in = image.pixels.data() + i * channels;
      float* out = result.pixels.data() + i * channels;
      for (std::size_t c = 0; c < channels; ++c) centred[c] = in[c] - offset_in[c];
      for (std::size_t r = 0; r < channels; ++r) {
        float sum = 0;
        for (std::size_t c = 0; c < channels; ++c) sum += matrix[r * channels + c] * centred[c];
        out[r] = sum + offset_out[r];
      }
    }
  });
  return result;
}

}  // namespace

ColourPca colour_pca(const Image& image) {
  if (image.empty()) throw Error("an empty image has no principal colours");
  const auto n = static_cast<std::size_t>(image.channels);
  const auto pixels = area(image.size());
  auto mean = sum_over_pixels(image, n, [n](const float* x, double* sum) {
    for (std::size_t c = 0; c < n; ++c) sum[c] += static_cast<double>(x[c]);
  });
  for (double& m : mean) m /= pixels;
  auto covariance = sum_over_pixels(image, n * n, [&](const float* x, double* sum) {
    for (std::size_t r = 0; r < n; ++r) {
      const double xr = static_cast<double>(x[r]) - mean[r];
      for (std::size_t c = r; c < n; ++c)
        sum[r * n + c] += xr * (static_cast<double>(x[c]) - mean[c]);
    }
  });
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = r; c < n; ++c) covariance[c * n + r] = covariance[r * n + c] /= pixels;

  float magnitude = 0;
  for (const float x : image.pixels) magnitude = std::max(magnitude, std::abs(x));
  const Eigen eigen = symmetric_eigen(std::move(covariance), n);
  ColourPca pca{
      image.channels, {mean.begin(), mean.end()}, {eigen.vectors.begin(), eigen.vectors.end()}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const double deviation = portable::sqrt(std::max(eigen.values[i], 0.0));
    const bool flat = deviation <= 1e-6 * static_cast<double>(magnitude);
    pca.deviation.push_back(flat ? 0.0f : static_cast<float>(deviation));
    fix_sign({pca.axes.data() + i * n, n});
  }
  return pca;
}

double total_deviation(const ColourPca& pca) {
  double variance = 0;
  for (const float deviation : pca.deviation) variance += double{deviation} * double{deviation};
  return std::sqrt(variance);
}

Image along_axes(const Image& image, const ColourPca& pca, double scale, int axes, int channels) {
  if (image.channels != pca.channels)
    throw Error("an image of {} channels does not fit principal axes of {}", image.channels,
                pca.channels);
  Image result(image.size(), channels);
  const int used = std::min({axes, channels, image.channels});
  parallel_for(image.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < image.width; ++x)
        for (int k = 0; k < used; ++k) {
          const float* axis = pca.axes.data() + k * image.channels;
          double sum = 0;
          for (int c = 0; c < image.channels; ++c)
            sum += double{axis[c]} *
                   (double{image.at(x, y)[c]} - double{pca.mean[static_cast<std::size_t>(c)]});
          result.at(x, y)[k] = static_cast<float>(sum * scale);
        }
  });
  return result;
}

Image whitened(const Image& image, const ColourPca& pca) {
  const std::size_t n = pca.mean.size();
  std::vector<float> matrix(n * n);
  for (std::size_t i = 0; i < n * n; ++i) {
    const float deviation = pca.deviation[i / n];
    matrix[i] = deviation > 0 ? pca.axes[i] / deviation : 0;
  }
  return transformed(image, pca.mean, matrix, std::vector<float>(n));
}

Image unwhitened(const Image& image, const ColourPca& pca) {
  const std::size_t n = pca.mean.size();
  std::vector<float> matrix(n * n);
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = 0; c < n; ++c) matrix[r * n + c] = pca.axes[c * n + r] * pca.deviation[c];
  return transformed(image, std::vector<float>(n), matrix, pca.mean);
}

}  // namespace gramloom
