#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "classic/pixel_levels.h"
#include "core/random.h"

namespace gramloom::pixel {

/// A neighbourhood, projected to its principal components: one cache line.
inline constexpr int feature_size = 16;
struct alignas(64) Feature : std::array<float, feature_size> {
  Feature() : std::array<float, feature_size>{} {}
};

/// Square neighbourhoods of (2·radius + 1)² pixels, weighted by a Gaussian about their centre and
/// projected to the 16 dimensions in which those of a level differ most (Lefebvre & Hoppe 2005,
/// section 4.3, take 6). Euclidean distances of features are those of neighbourhoods, less what
/// the other dimensions hold.
struct Projection {
  int radius = 0;
  int channels = 0;
  std::vector<Feature> basis;  // [pixel of the neighbourhood][channel], weights in it

  int side() const { return 2 * radius + 1; }

  /// window: first value of the neighbourhood's first pixel; row, pixel: values from a row, and
  /// from a pixel, to the next.
  Feature project(const float* window, std::ptrdiff_t row, std::ptrdiff_t pixel) const;
};

/// Principal components of at most 4096 neighbourhoods, by subspace iteration.
Projection make_projection(const Level& level, int radius, Random random);

/// The feature of every sample of the level; beyond its edges it is mirrored.
std::vector<Feature> make_features(const Level& level, const Projection& projection);

/// The Gaussian weight of each pixel of a neighbourhood, row by row; the deviation is side / 6.4,
/// as in Efros & Leung's own program.
std::vector<float> gaussian_weights(int radius);

/// Σ (a − b)²
float squared_distance(const Feature& a, const Feature& b);

/// How far apart like samples are to be, so that they don't name the same place again: a twentieth
/// of the level.
int distance_apart(const Level& level);

/// For each sample of the level, `count` samples whose features are near its own: itself first,
/// then the others from near to far, each at least `apart` samples away from it in x or y. Fewer
/// such samples: the rest are itself again. Shape [sample][count].
/// Approximate: partitions by random hyperplanes to leaves that are searched in full, then
/// neighbours' lists, shifted, are tried (as Barnes et al. 2009 propagate).
std::vector<Point> similar_samples(const Level& level, const std::vector<Feature>& features,
                                   int count, int apart, Random random);

}  // namespace gramloom::pixel
