#include <ATen/ATen.h>

#include <algorithm>
#include <chrono>

#include "neural/module.h"
#include "neural/openmp.h"

namespace gramloom::neural {

double measure_blas() {
  const InThisThread in_this_thread;
  constexpr std::int64_t side = 256;
  const at::Tensor a = at::ones({side, side}), b = at::ones({side, side});
  double best = 0;
  for (int i = 0; i < 4; ++i) {  // the first one also starts the library
    const auto start = std::chrono::steady_clock::now();
    const at::Tensor product = at::mm(a, b);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    best = std::max(best, 2e-9 * side * side * side / time.count());
  }
  return best;
}

}  // namespace gramloom::neural
