#pragma once

#include "neural/normal_numbers.h"

namespace gramloom::neural {

/// Normal numbers that every run of the tests has alike.
inline at::Tensor numbers(at::IntArrayRef shape, std::uint64_t seed,
                          at::ScalarType type = at::kFloat) {
  return normal_numbers(Random(seed), shape).to(type);
}

/// Largest difference relative to the largest value.
inline double relative_difference(const at::Tensor& a, const at::Tensor& b) {
  if (a.sizes() != b.sizes()) return 1e30;
  const at::Tensor x = a.to(at::kDouble), y = b.to(at::kDouble);
  return (x - y).abs().max().item<double>() / (y.abs().max().item<double>() + 1e-300);
}

}  // namespace gramloom::neural
