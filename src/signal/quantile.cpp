#include "signal/quantile.h"

#include "core/simd.h"

namespace gramloom {

namespace {

// As Quantiles::operator(): the same operations in the same order.
GRAMLOOM_SIMD void interpolate(const float* sorted, int last, double step, double first,
                               float* values, int count) {
  for (int i = 0; i < count; ++i) {
    double position = (first + i + 0.5) * step - 0.5;
    position = position < 0 ? 0 : position;
    position = position > last ? last : position;
    const int below = static_cast<int>(position);
    const int above = below < last ? below + 1 : last;
    const double weight = position - below;
    values[i] = static_cast<float>((1 - weight) * static_cast<double>(sorted[below]) +
                                   weight * static_cast<double>(sorted[above]));
  }
}

}  // namespace

void Quantiles::get(std::size_t first, std::span<float> values) const {
  if (same_)
    std::copy_n(sorted_.begin() + static_cast<std::ptrdiff_t>(first), values.size(),
                values.begin());
  else
    interpolate(sorted_.data(), static_cast<int>(sorted_.size() - 1), step_,
                static_cast<double>(first), values.data(), static_cast<int>(values.size()));
}

}  // namespace gramloom
