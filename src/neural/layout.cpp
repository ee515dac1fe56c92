#include "neural/layout.h"

#include <algorithm>

namespace gramloom::neural {

namespace {

// Σ a(p + s) b(p) over all positions, and channels, for shifts s on a torus of that shape.
at::Tensor products(const at::Tensor& a, const at::Tensor& b,
                    const std::vector<std::int64_t>& shape) {
  return at::fft_irfft2((at::fft_rfft2(a, shape) * at::conj(at::fft_rfft2(b, shape))).sum(0),
                        shape);
}

// Shifts along an axis as they lie on the torus: 0, 1, …, −2, −1.
at::Tensor shifts(std::int64_t length, std::int64_t positive) {
  at::Tensor result = at::arange(length, at::kLong);
  result.narrow(0, positive, length - positive).sub_(length);
  return result;
}

}  // namespace

double strongest_correlation(const at::Tensor& picture, const at::Tensor& exemplar,
                             std::int64_t beyond) {
  const at::Tensor a = (picture - picture.mean({1, 2}, true)).to(at::kDouble);
  const at::Tensor b = (exemplar - exemplar.mean({1, 2}, true)).to(at::kDouble);
  const std::vector<std::int64_t> shape{a.size(1) + b.size(1) - 1, a.size(2) + b.size(2) - 1};
  const at::Tensor one_a = at::ones_like(a[0]).unsqueeze(0),
                   one_b = at::ones_like(b[0]).unsqueeze(0);
  const at::Tensor covered = products(one_a, one_b, shape);
  const at::Tensor energy = products(a.square().sum(0, true), one_b, shape).clamp_min(0) *
                            products(one_a, b.square().sum(0, true), shape).clamp_min(0);
  const double smaller = static_cast<double>(std::min(one_a.numel(), one_b.numel()));
  const at::Tensor far = at::max(shifts(shape[0], a.size(1)).abs().unsqueeze(1),
                                 shifts(shape[1], a.size(2)).abs().unsqueeze(0)) > beyond;
  // Where both are flat there is nothing to correlate.
  const double flat = 1e-6 * a.square().sum().item<double>() * b.square().sum().item<double>();
  const at::Tensor valid = far & (covered > 0.25 * smaller - 0.5) & (energy > flat);
  const at::Tensor correlation = products(a, b, shape) / energy.clamp_min(1e-300).sqrt();
  return std::max(0.0,
                  at::where(valid, correlation, at::zeros_like(correlation)).max().item<double>());
}

double layout_copied(const at::Tensor& picture, const at::Tensor& exemplar, Tile wraps) {
  at::Tensor continued = picture;
  const auto go_on = [&](std::int64_t axis) {
    const std::int64_t more = std::min(picture.size(axis), exemplar.size(axis));
    continued = at::cat({continued, continued.narrow(axis, 0, more)}, axis);
  };
  if (tiles_y(wraps)) go_on(1);
  if (tiles_x(wraps)) go_on(2);
  const std::int64_t sixth = std::min(exemplar.size(1), exemplar.size(2)) / 6;
  return strongest_correlation(continued, exemplar) -
         strongest_correlation(exemplar, exemplar, sixth);
}

}  // namespace gramloom::neural
