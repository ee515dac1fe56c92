#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace gramloom::neural {

/// The Wasserstein distance W₁ in one dimension between two samples of any sizes, and the function
/// of a value whose mean over the first one less that over the second it is: the potential of
/// Kantorovich and Rubinstein (Villani 2003, "Topics in optimal transportation", theorem 1.14).
/// Its slope at v is 1 where more of the second sample than of the first is below v, so that a
/// value there is to become smaller; −1 where less is; 0 beyond both samples. Both are counted in
/// `bins` equal bins of their common range, within which they count as even: no sorting, and slopes
/// for values that were not in the sample.
class Potential {
 public:
  static constexpr int bins = 2048;

  struct Range {
    float low, high;
  };
  /// Of no values: nothing, as far as others are joined to it.
  static Range range_of(std::span<const float> values);
  /// How many values lie in each bin of a range that holds them all. Counts of parts add up.
  using Counts = std::array<std::int32_t, bins>;
  static Counts count(std::span<const float> values, Range range);

  Potential() = default;
  Potential(std::span<const float> values, std::span<const float> goal);
  /// Of samples with these counts.
  Potential(Range range, const Counts& values, const Counts& goal);

  double distance() const { return distance_; }
  /// Each value becomes `weight` times the slope there.
  void to_slopes(std::span<float> values, float weight) const;

 private:
  float low_ = 0, per_bin_ = 0;
  double distance_ = 0;
  std::array<float, bins + 2> slopes_{};  // the first and the last: beyond the range
};

}  // namespace gramloom::neural
