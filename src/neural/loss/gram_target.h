#pragma once

#include "neural/loss/gram.h"
#include "neural/loss/moments.h"

namespace gramloom::neural {

/// What one layer of the exemplar has, and how far a result is from it (gram.h).
class GramTarget {
 public:
  GramTarget(const Moments& exemplar, const GramParams& options);
  /// E, a scalar.
  at::Tensor distance(const Moments& result) const;

 private:
  // `products` of the maps from `first` on, centred and standardised with the means of `m`.
  at::Tensor transformed(const at::Tensor& products, const Moments& m, std::int64_t first) const;

  GramParams options_;
  at::Tensor mean_, inverse_deviation_, gram_;
  std::vector<Moments::Shifted> shifted_;  // centred and standardised
  double scale_ = 1;
};

}  // namespace gramloom::neural
