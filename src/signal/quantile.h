#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace gramloom {

/// The quantile function of ascending values, as seen from a sample of another size: each value
/// stands for the middle of its share, so rank (i + ½)/ranks of the sample is rank (j + ½)/m of the
/// m values, and what lies between two of them is interpolated linearly. `sorted` is not empty and
/// must outlive this.
class Quantiles {
 public:
  Quantiles(std::span<const float> sorted, std::size_t ranks)
      : sorted_(sorted),
        step_(static_cast<double>(sorted.size()) / static_cast<double>(ranks)),
        same_(sorted.size() == ranks) {}

  double operator()(std::size_t rank) const {
    if (same_) return double{sorted_[rank]};
    const double last = static_cast<double>(sorted_.size() - 1);
    const double position = std::clamp((static_cast<double>(rank) + 0.5) * step_ - 0.5, 0.0, last);
    const auto below = static_cast<std::size_t>(position);
    const auto above = std::min(below + 1, sorted_.size() - 1);
    const double weight = position - static_cast<double>(below);
    return (1 - weight) * double{sorted_[below]} + weight * double{sorted_[above]};
  }

  /// Those of ranks `first` to first + values.size(), as floats: faster than one by one.
  void get(std::size_t first, std::span<float> values) const;

 private:
  std::span<const float> sorted_;
  double step_;
  bool same_;
};

}  // namespace gramloom
