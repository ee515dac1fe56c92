#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "classic/pixel_levels.h"
#include "core/random.h"

namespace gramloom::pixel {

/// A known pixel of a neighbourhood: where it lies (see Reference::offset), what its error counts,
/// and its colour.
struct Known {
  std::ptrdiff_t offset;
  float weight;
  const float* colour;
};

/// A level of the exemplar against which neighbourhoods are compared value by value. Those that
/// leave the exemplar have a great error: they are taken only where none stays inside, as in an
/// exemplar smaller than the neighbourhood.
class Reference {
 public:
  /// reach: how far neighbourhoods extend, in pixels of the level.
  Reference(const Level& level, int reach);

  /// Of the pixel (dx, dy) pixels away, for Known.
  std::ptrdiff_t offset(int dx, int dy) const;

  /// What lies farther away and only decides between places that fit alike: the same sum, but of
  /// samples that may not be used, or lie beyond the exemplar, it takes the mean of all others.
  std::vector<float> far_errors(std::span<const Known> neighbourhood) const;

  /// Σ weight · |colour − exemplar's colour|² about sample p.
  float error(std::span<const Known> neighbourhood, Point p) const;
  /// The same for every sample of the level, on all threads.
  std::vector<float> errors(std::span<const Known> neighbourhood) const;

 private:
  Size size_;
  int step_;
  int border_;
  std::vector<Image> planes_;  // one channel each, with a border
  Image usable_;               // likewise: 1 or 0
};

/// The error of a sample that may not be used: above all others.
inline constexpr float out_of_reach = 1e30f;

/// Whether the least error is below that of pixels taken at random: 2 per unit of weight, since the
/// variance of the colours is 1. Where it is not, every candidate leaves the exemplar or belongs
/// elsewhere, and the search must go beyond them.
bool fits_at_all(std::span<const float> errors, std::span<const Known> neighbourhood);

/// The index of an error, at random among those at most (1 + tolerance) times the least.
std::size_t pick(std::span<const float> errors, double tolerance, Random& random);

}  // namespace gramloom::pixel
