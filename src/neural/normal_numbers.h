#pragma once

#include <ATen/ATen.h>

#include "core/image.h"
#include "core/random.h"
#include "core/threads.h"

namespace gramloom::neural {

/// Floats of mean 0 and deviation 1, in the order that `random` gives them.
inline at::Tensor normal_numbers(Random random, at::IntArrayRef shape) {
  at::Tensor numbers = at::empty(shape, at::kFloat);
  float* values = numbers.data_ptr<float>();
  for (std::int64_t i = 0; i < numbers.numel(); ++i) values[i] = random.normal();
  return numbers;
}

/// A picture (channels, height, width) of such numbers, each row with a stream of its own.
inline at::Tensor white_noise(Random random, int channels, Size size) {
  at::Tensor planes = at::empty({channels, size.height, size.width}, at::kFloat);
  float* values = planes.data_ptr<float>();
  parallel_for(std::int64_t{channels} * size.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      Random own = random.stream(static_cast<std::uint64_t>(row));
      for (int x = 0; x < size.width; ++x) values[row * size.width + x] = own.normal();
    }
  });
  return planes;
}

}  // namespace gramloom::neural
