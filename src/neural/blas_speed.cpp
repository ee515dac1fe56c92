#include <ATen/ATen.h>

#include <algorithm>
#include <chrono>

#include "neural/module.h"
#include "neural/openmp.h"

namespace gramloom::neural {

namespace {

// Of products of two square matrices, the best of `repeats`: the first one also starts the library.
double product_speed(std::int64_t side, int repeats) {
  const at::Tensor a = at::ones({side, side}), b = at::ones({side, side});
  double best = 0;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const at::Tensor product = at::mm(a, b);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    best = std::max(best, 2.0 * static_cast<double>(side * side * side) / time.count());
  }
  return best;
}

}  // namespace

double measure_blas() {
  const InThisThread in_this_thread;
  return product_speed(256, 4) / 1e9;
}

double measure_operations() { return product_speed(1024, 8); }

}  // namespace gramloom::neural
