#pragma once

#include <ATen/ATen.h>

#include "core/random.h"

namespace gramloom::neural {

/// Floats of mean 0 and deviation 1, in the order that `random` gives them.
inline at::Tensor normal_numbers(Random random, at::IntArrayRef shape) {
  at::Tensor numbers = at::empty(shape, at::kFloat);
  float* values = numbers.data_ptr<float>();
  for (std::int64_t i = 0; i < numbers.numel(); ++i) values[i] = random.normal();
  return numbers;
}

}  // namespace gramloom::neural
