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

/// A level of the exemplar against which neighbourhoods are compared value by value. Beyond its
/// edges it is mirrored, so that every sample is a candidate.
class Reference {
 public:
  /// reach: how far neighbourhoods extend, in pixels of the level.
  Reference(const Level& level, int reach);

  /// Of the pixel (dx, dy) pixels away, for Known.
  std::ptrdiff_t offset(int dx, int dy) const;

  /// Σ weight · |colour − exemplar's colour|² about sample p.
  float error(std::span<const Known> neighbourhood, Point p) const;
  /// The same for every sample of the level, on all threads.
  std::vector<float> errors(std::span<const Known> neighbourhood) const;

 private:
  Size size_;
  int step_;
  int border_;
  std::vector<Image> planes_;  // one channel each, with a mirrored border
};

/// The index of an error, at random among those at most (1 + tolerance) times the least.
std::size_t pick(std::span<const float> errors, double tolerance, Random& random);

}  // namespace gramloom::pixel
