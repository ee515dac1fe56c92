#include "classic/pixel_features.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom::pixel {
namespace {

constexpr auto dims = static_cast<std::size_t>(feature_size);

/// out = Σ_i values[i] · basis[i], over `count` rows of the basis.
GRAMLOOM_SIMD void weighted_sum(const float* values, std::size_t count, const float* basis,
                                float* out) {
  // Four sums at a time: one alone would wait for each addition.
  float sums[4][dims] = {};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (std::size_t part = 0; part < 4; ++part)
      for (std::size_t d = 0; d < dims; ++d)
        sums[part][d] += values[i + part] * basis[(i + part) * dims + d];
  for (; i < count; ++i)
    for (std::size_t d = 0; d < dims; ++d) sums[0][d] += values[i] * basis[i * dims + d];
  for (std::size_t d = 0; d < dims; ++d)
    out[d] = (sums[0][d] + sums[1][d]) + (sums[2][d] + sums[3][d]);
}

/// sums[i] += values[i] · feature
GRAMLOOM_SIMD void add_outer_product(const float* values, std::size_t count, const float* feature,
                                     float* sums) {
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t d = 0; d < dims; ++d) sums[i * dims + d] += values[i] * feature[d];
}

/// The columns of `basis` [rows][feature_size] become orthonormal (Gram–Schmidt, twice for
/// accuracy); a column that depends on the others becomes 0.
void orthonormalise(std::vector<float>& basis) {
  const std::size_t rows = basis.size() / dims;
  const auto dot = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t i = 0; i < rows; ++i)
      sum += static_cast<double>(basis[i * dims + a]) * static_cast<double>(basis[i * dims + b]);
    return sum;
  };
  for (std::size_t column = 0; column < dims; ++column) {
    const double before = std::sqrt(dot(column, column));
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t other = 0; other < column; ++other) {
        const auto shadow = static_cast<float>(dot(column, other));
        for (std::size_t i = 0; i < rows; ++i)
          basis[i * dims + column] -= shadow * basis[i * dims + other];
      }
    const double norm = std::sqrt(dot(column, column));
    const auto scale = static_cast<float>(norm > 1e-4 * before && norm > 1e-30 ? 1 / norm : 0);
    for (std::size_t i = 0; i < rows; ++i) basis[i * dims + column] *= scale;
  }
}

void gather(const float* window, std::ptrdiff_t row, std::ptrdiff_t pixel, int side, int channels,
            float* out) {
  for (int y = 0; y < side; ++y, window += row) {
    if (pixel == channels) {
      out = std::copy_n(window, side * channels, out);
    } else {
      const float* from = window;
      for (int x = 0; x < side; ++x, from += pixel) out = std::copy_n(from, channels, out);
    }
  }
}

}  // namespace

std::vector<float> gaussian_weights(int radius) {
  const double deviation = (2 * radius + 1) / 6.4;
  std::vector<float> weights;
  for (int y = -radius; y <= radius; ++y)
    for (int x = -radius; x <= radius; ++x)
      weights.push_back(
          static_cast<float>(std::exp(-(x * x + y * y) / (2 * deviation * deviation))));
  return weights;
}

Feature Projection::project(const float* window, std::ptrdiff_t row, std::ptrdiff_t pixel) const {
  // Radius 15 and 4 channels at most.
  float values[31 * 31 * 4];
  gather(window, row, pixel, side(), channels, values);
  Feature feature;
  weighted_sum(values, basis.size() / dims, basis.data(), feature.data());
  return feature;
}

Projection make_projection(const Level& level, int radius, Random random) {
  Projection projection{radius, level.colours.channels, {}};
  const int border = radius * level.step;
  const Image padded = mirrored(level.colours, border);
  const std::ptrdiff_t row =
      static_cast<std::ptrdiff_t>(padded.width) * padded.channels * level.step;
  const std::ptrdiff_t pixel = static_cast<std::ptrdiff_t>(padded.channels) * level.step;
  const auto weights = gaussian_weights(radius);
  const std::size_t length = weights.size() * static_cast<std::size_t>(padded.channels);

  const int samples = std::min(level.count(), 4096);
  std::vector<float> windows(static_cast<std::size_t>(samples) * length);
  for (int s = 0; s < samples; ++s) {
    const Point p =
        level.point(static_cast<int>(static_cast<std::int64_t>(s) * level.count() / samples));
    float* window = windows.data() + static_cast<std::size_t>(s) * length;
    gather(padded.at(p.x, p.y), row, pixel, projection.side(), padded.channels, window);
    for (std::size_t i = 0; i < length; ++i)
      window[i] *= std::sqrt(weights[i / static_cast<std::size_t>(padded.channels)]);
  }

  projection.basis.resize(length * dims);
  for (float& value : projection.basis) value = random.normal();
  orthonormalise(projection.basis);
  for (int iteration = 0; iteration < 6; ++iteration) {
    std::vector<float> sums(length * dims, 0.0f);
    Feature feature;
    for (int s = 0; s < samples; ++s) {
      const float* window = windows.data() + static_cast<std::size_t>(s) * length;
      weighted_sum(window, length, projection.basis.data(), feature.data());
      add_outer_product(window, length, feature.data(), sums.data());
    }
    orthonormalise(sums);
    projection.basis = std::move(sums);
  }
  for (std::size_t i = 0; i < projection.basis.size(); ++i)
    projection.basis[i] *= std::sqrt(weights[i / dims / static_cast<std::size_t>(padded.channels)]);
  return projection;
}

std::vector<Feature> make_features(const Level& level, const Projection& projection) {
  const Image padded = mirrored(level.colours, projection.radius * level.step);
  const std::ptrdiff_t row =
      static_cast<std::ptrdiff_t>(padded.width) * padded.channels * level.step;
  const std::ptrdiff_t pixel = static_cast<std::ptrdiff_t>(padded.channels) * level.step;
  std::vector<Feature> features(static_cast<std::size_t>(level.count()));
  parallel_for(level.count(), 4096, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = begin; i < end; ++i) {
      const Point p = level.point(static_cast<int>(i));
      features[static_cast<std::size_t>(i)] = projection.project(padded.at(p.x, p.y), row, pixel);
    }
  });
  return features;
}

}  // namespace gramloom::pixel
