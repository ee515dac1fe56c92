#pragma once

#include <optional>
#include <span>

namespace gramloom {

/// A mean and how sure it is: the true one lies within `half_width` of it 95 times of 100.
struct MeanInterval {
  double mean = 0;
  std::optional<double> half_width;  // none: of one value
  int count = 0;

  friend bool operator==(const MeanInterval&, const MeanInterval&) = default;
};

/// Student's interval ("The probable error of a mean", 1908) of independent values, which must not
/// be none: the half width is t(0.975, n − 1) · s / √n, with s the deviation of n − 1 freedoms. It
/// supposes that means are about normal, as they are from a dozen values on unless one of them
/// stands alone; it may reach beyond what a value can be.
MeanInterval mean_interval(std::span<const double> values);

/// The quantile t of Student's distribution, for a probability in [0.5, 1) and degrees of freedom
/// from 1 up: the distribution by its finite sums (Abramowitz & Stegun 1964, 26.7.3 and 26.7.4).
double student_quantile(double probability, int degrees);

}  // namespace gramloom
