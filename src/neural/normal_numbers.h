#pragma once

#include <ATen/ATen.h>

#include "core/image.h"
#include "core/random.h"
#include "core/threads.h"
#include "neural/network/rows.h"

namespace gramloom::neural {

/// Floats of mean 0 and deviation 1, in the order that `random` gives them.
inline at::Tensor normal_numbers(Random random, at::IntArrayRef shape) {
  at::Tensor numbers = at::empty(shape, at::kFloat);
  float* values = numbers.data_ptr<float>();
  for (std::int64_t i = 0; i < numbers.numel(); ++i) values[i] = random.normal();
  return numbers;
}

/// Some rows of a picture (channels, height, width) of such numbers, each row with a stream of its
/// own.
inline at::Tensor white_noise(Random random, int channels, Size size, Rows rows) {
  at::Tensor planes = at::empty({channels, rows.count(), size.width}, at::kFloat);
  float* values = planes.data_ptr<float>();
  parallel_for(channels * rows.count(), 16, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int64_t row = i / rows.count() * size.height + rows.begin + i % rows.count();
      Random own = random.stream(static_cast<std::uint64_t>(row));
      for (int x = 0; x < size.width; ++x) values[i * size.width + x] = own.normal();
    }
  });
  return planes;
}
inline at::Tensor white_noise(Random random, int channels, Size size) {
  return white_noise(random, channels, size, {0, size.height});
}

}  // namespace gramloom::neural
