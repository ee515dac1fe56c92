#include "classic/pixel_features.h"

#include <algorithm>
#include <cmath>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom::pixel {
namespace {

/// A feature in vector registers, however many the machine needs for it.
using Lanes = float __attribute__((vector_size(feature_size * sizeof(float)), may_alias));

/// feature = Σ_i values[i] · basis[i]
GRAMLOOM_SIMD void weighted_sum(const float* values, std::size_t count, const Feature* basis,
                                Feature* feature) {
  const auto* rows = reinterpret_cast<const Lanes*>(basis);
  // Four sums at a time: one alone would wait for each addition.
  Lanes a{}, b{}, c{}, d{};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    a += values[i] * rows[i];
    b += values[i + 1] * rows[i + 1];
    c += values[i + 2] * rows[i + 2];
    d += values[i + 3] * rows[i + 3];
  }
  for (; i < count; ++i) a += values[i] * rows[i];
  *reinterpret_cast<Lanes*>(feature) = (a + b) + (c + d);
}

/// sums[i] += values[i] · feature
GRAMLOOM_SIMD void add_outer_product(const float* values, std::size_t count, const Feature* feature,
                                     Feature* sums) {
  auto* rows = reinterpret_cast<Lanes*>(sums);
  const Lanes lanes = *reinterpret_cast<const Lanes*>(feature);
  for (std::size_t i = 0; i < count; ++i) rows[i] += values[i] * lanes;
}

/// The columns of `basis` become orthonormal (Gram–Schmidt, twice for
/// accuracy); a column that depends on the others becomes 0.
void orthonormalise(std::vector<Feature>& basis) {
  const auto dot = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (const Feature& row : basis)
      sum += static_cast<double>(row[a]) * static_cast<double>(row[b]);
    return sum;
  };
  for (std::size_t column = 0; column < feature_size; ++column) {
    const double before = std::sqrt(dot(column, column));
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t other = 0; other < column; ++other) {
        const auto shadow = static_cast<float>(dot(column, other));
        for (Feature& row : basis) row[column] -= shadow * row[other];
      }
    const double norm = std::sqrt(dot(column, column));
    const auto scale = static_cast<float>(norm > 1e-4 * before && norm > 1e-30 ? 1 / norm : 0);
    for (Feature& row : basis) row[column] *= scale;
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

GRAMLOOM_SIMD float squared_distance(const Feature& a, const Feature& b) {
  const Lanes difference =
      *reinterpret_cast<const Lanes*>(&a) - *reinterpret_cast<const Lanes*>(&b);
  const Lanes squares = difference * difference;
  using Eight = float __attribute__((vector_size(32)));
  using Four = float __attribute__((vector_size(16)));
  const Eight eight = __builtin_shufflevector(squares, squares, 0, 1, 2, 3, 4, 5, 6, 7) +
                      __builtin_shufflevector(squares, squares, 8, 9, 10, 11, 12, 13, 14, 15);
  const Four four = __builtin_shufflevector(eight, eight, 0, 1, 2, 3) +
                    __builtin_shufflevector(eight, eight, 4, 5, 6, 7);
  return (four[0] + four[1]) + (four[2] + four[3]);
}

Feature Projection::project(const float* window, std::ptrdiff_t row, std::ptrdiff_t pixel) const {
  // Radius 15 and 4 channels at most.
  float values[31 * 31 * 4];
  gather(window, row, pixel, side(), channels, values);
  Feature feature;
  weighted_sum(values, basis.size(), basis.data(), &feature);
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

  projection.basis.resize(length);
  for (Feature& start : projection.basis)
    for (float& value : start) value = random.normal();
  orthonormalise(projection.basis);
  for (int iteration = 0; iteration < 6; ++iteration) {
    std::vector<Feature> sums(length);
    Feature feature;
    for (int s = 0; s < samples; ++s) {
      const float* window = windows.data() + static_cast<std::size_t>(s) * length;
      weighted_sum(window, length, projection.basis.data(), &feature);
      add_outer_product(window, length, &feature, sums.data());
    }
    orthonormalise(sums);
    projection.basis = std::move(sums);
  }
  for (std::size_t i = 0; i < length; ++i)
    for (float& value : projection.basis[i])
      value *= std::sqrt(weights[i / static_cast<std::size_t>(padded.channels)]);
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
