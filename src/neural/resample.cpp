#include "neural/resample.h"

#include <algorithm>
#include <cmath>

namespace gramloom::neural {

namespace {

double keys(double t) {
  t = std::abs(t);
  if (t < 1) return (1.5 * t - 2.5) * t * t + 1;
  if (t < 2) return ((-0.5 * t + 2.5) * t - 4) * t + 2;
  return 0;
}

// (to, from): row i holds the weights of the old positions in new position i.
at::Tensor weights(std::int64_t from, std::int64_t to, bool wraps, at::TensorOptions options) {
  at::Tensor matrix = at::zeros({to, from}, at::kDouble);
  auto w = matrix.accessor<double, 2>();
  const double ratio = static_cast<double>(from) / static_cast<double>(to);
  const double width = std::max(1.0, ratio);
  for (std::int64_t i = 0; i < to; ++i) {
    const double centre = (static_cast<double>(i) + 0.5) * ratio - 0.5;
    const auto first = static_cast<std::int64_t>(std::ceil(centre - 2 * width));
    const auto last = static_cast<std::int64_t>(std::floor(centre + 2 * width));
    for (std::int64_t k = first; k <= last; ++k) {
      const std::int64_t source =
          wraps ? ((k % from) + from) % from : std::clamp<std::int64_t>(k, 0, from - 1);
      w[i][source] += keys((static_cast<double>(k) - centre) / width);
    }
  }
  return (matrix / matrix.sum(1, true)).to(options);
}

}  // namespace

at::Tensor resample(const at::Tensor& planes, Size size, Tile tile) {
  if (planes.size(1) == size.height && planes.size(2) == size.width) return planes.clone();
  const at::Tensor rows = weights(planes.size(1), size.height, tiles_y(tile), planes.options());
  const at::Tensor columns = weights(planes.size(2), size.width, tiles_x(tile), planes.options());
  return at::matmul(rows, at::matmul(planes, columns.t())).contiguous();
}

}  // namespace gramloom::neural
