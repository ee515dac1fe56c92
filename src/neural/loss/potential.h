#pragma once

#include <array>
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

  Potential() = default;
  Potential(std::span<const float> values, std::span<const float> goal);

  double distance() const { return distance_; }
  /// Each value becomes `weight` times the slope there.
  void to_slopes(std::span<float> values, float weight) const;

 private:
  float low_ = 0, per_bin_ = 0;
  double distance_ = 0;
  std::array<float, bins + 2> slopes_{};  // the first and the last: beyond the range
};

}  // namespace gramloom::neural
