#include "neural/loss/picture_terms.h"

#include <torch/csrc/autograd/autograd.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gramloom::neural {

namespace {

// Of a frequency: the root has no derivative at 0.
constexpr double least_power = 1e-8;

// Transforms need memory: of a large picture a channel at a time.
constexpr std::int64_t values_transformed_at_once = 1 << 20;

// f(picture) is a scalar; adds weight times its gradient and returns it.
template <class F>
double add_gradient(const at::Tensor& picture, double weight, at::Tensor& gradient, F&& f) {
  const c10::AutoGradMode gradients(true);
  const at::Tensor x = picture.detach().requires_grad_(true);
  const at::Tensor value = f(x);
  gradient.add_(torch::autograd::grad({value}, {x})[0], weight);
  return value.template item<double>();
}

at::Tensor centred(const at::Tensor& planes) { return planes - planes.mean({1, 2}, true); }

double inverse_of_sum(const at::Tensor& squares) {
  const double sum = squares.sum().item<double>();
  return sum > 0 ? 1 / sum : 0;
}

// Sums of products of each channel with itself at every shift on a torus of that shape, which zeros
// fill up.
at::Tensor self_products(const at::Tensor& planes, const std::vector<std::int64_t>& shape) {
  const at::Tensor transformed = at::fft_rfft2(planes, shape);
  return at::fft_irfft2(at::real(transformed * at::conj(transformed)), shape);
}

at::Tensor without_lag_0(at::Tensor autocorrelation) {
  autocorrelation.select(1, 0).select(1, autocorrelation.size(2) / 2).zero_();
  return autocorrelation;
}

// Lags as autocorrelation() gives them, at their places on a torus of that size, with those of
// negative dy by symmetry.
at::Tensor on_torus(const at::Tensor& lags, Size size) {
  const std::int64_t rows = lags.size(1), half = (lags.size(2) + 1) / 2;
  at::Tensor torus = at::zeros({lags.size(0), size.height, size.width}, lags.options());
  const auto place = [&](const at::Tensor& part, std::int64_t first) {
    at::Tensor into = torus.narrow(1, first, part.size(1));
    into.narrow(2, 0, half).copy_(part.narrow(2, half - 1, half));
    into.narrow(2, size.width - half + 1, half - 1).copy_(part.narrow(2, 0, half - 1));
  };
  place(lags, 0);
  if (rows > 1) place(lags.narrow(1, 1, rows - 1).flip({1, 2}), size.height - rows + 1);
  return torus;
}

// Differences along x and y; on an axis that does not wrap, the last one is 0.
at::Tensor total_variation(const at::Tensor& planes, Tile wraps) {
  const auto difference = [&](std::int64_t axis, bool wrap) {
    const at::Tensor next = at::roll(planes, -1, axis);
    if (wrap) return next - planes;
    const std::int64_t side = planes.size(axis);
    return at::constant_pad_nd((next - planes).narrow(axis, 0, side - 1),
                               axis == 1 ? at::IntArrayRef({0, 0, 0, 1}) : at::IntArrayRef({0, 1}));
  };
  const at::Tensor dx = difference(2, tiles_x(wraps)), dy = difference(1, tiles_y(wraps));
  return (dx * dx + dy * dy + 1e-8).sqrt().mean({1, 2});
}

}  // namespace

at::Tensor autocorrelation(const at::Tensor& planes, Size lags, Tile wraps) {
  const std::int64_t height = planes.size(1), width = planes.size(2);
  const std::int64_t padded_y = height + (tiles_y(wraps) ? 0 : lags.height);
  const std::int64_t padded_x = width + (tiles_x(wraps) ? 0 : lags.width);
  const at::Tensor products = self_products(planes, {padded_y, padded_x});
  // Rows of positive dy; columns of negative dx stand at the end.
  const at::Tensor rows = products.narrow(1, 0, lags.height);
  const at::Tensor sums = at::cat(
      {rows.narrow(2, padded_x - lags.width + 1, lags.width - 1), rows.narrow(2, 0, lags.width)},
      2);
  at::Tensor count_y = at::full({lags.height, 1}, static_cast<double>(height), planes.options());
  at::Tensor count_x =
      at::full({1, 2 * lags.width - 1}, static_cast<double>(width), planes.options());
  if (!tiles_y(wraps)) count_y -= at::arange(lags.height, planes.options()).view({-1, 1});
  if (!tiles_x(wraps))
    count_x -= at::arange(-lags.width + 1, lags.width, planes.options()).abs().view({1, -1});
  return sums / (count_y * count_x);
}

AutocorrelationTerm::AutocorrelationTerm(const at::Tensor& exemplar, Size target, Tile wraps)
    : lags_{std::max(1, std::min(static_cast<int>(exemplar.size(2)) / 4, target.width / 2)),
            std::max(1, std::min(static_cast<int>(exemplar.size(1)) / 4, target.height / 2))},
      wraps_(wraps),
      goal_(without_lag_0(autocorrelation(centred(exemplar), lags_, Tile::none))),
      scale_(inverse_of_sum(goal_.square())) {}

double AutocorrelationTerm::add(const at::Tensor& picture, double weight, std::uint64_t,
                                at::Tensor& gradient) const {
  return add_gradient(picture, weight, gradient, [&](const at::Tensor& x) {
    const at::Tensor own = without_lag_0(autocorrelation(centred(x), lags_, wraps_));
    return (own - goal_).square().sum() * scale_;
  });
}

SpectrumTerm::SpectrumTerm(const at::Tensor& exemplar, Size target) {
  const Size lags{std::max(1, std::min(static_cast<int>(exemplar.size(2)), target.width) / 2),
                  std::max(1, std::min(static_cast<int>(exemplar.size(1)), target.height) / 2)};
  const auto fade = [&](int count) {
    const at::Tensor t = at::arange(-count + 1, count, exemplar.options()) / count;
    return (t * 3.14159265358979).cos().add(1).div(2);
  };
  fade_ = on_torus((fade(lags.height).narrow(0, lags.height - 1, lags.height).view({-1, 1}) *
                    fade(lags.width).view({1, -1}))
                       .unsqueeze(0),
                   target)
              .squeeze(0);
  const at::Tensor torus = on_torus(autocorrelation(centred(exemplar), lags, Tile::none), target);
  const std::int64_t columns = target.width / 2 + 1;
  weight_ = at::full({columns}, 2.0, exemplar.options());
  weight_[0] = 1;
  if (target.width % 2 == 0) weight_[columns - 1] = 1;
  goal_ = modulus(torus);
  scale_ = inverse_of_sum(goal_.square() * weight_);
}

at::Tensor SpectrumTerm::modulus(const at::Tensor& correlation) const {
  return (at::real(at::fft_rfft2(correlation * fade_)).clamp_min(0) + least_power).sqrt();
}

double SpectrumTerm::add(const at::Tensor& picture, double weight, std::uint64_t,
                         at::Tensor& gradient) const {
  const std::vector<std::int64_t> shape{picture.size(1), picture.size(2)};
  const std::int64_t positions = shape[0] * shape[1];
  const auto m = static_cast<double>(positions);
  const std::int64_t at_once = std::max<std::int64_t>(1, values_transformed_at_once / positions);
  double sum = 0;
  for (std::int64_t c = 0; c < picture.size(0); c += at_once) {
    const std::int64_t count = std::min(at_once, picture.size(0) - c);
    // X is the transform; |X|² that of the correlation, which is faded; S is |X|² thereafter.
    const at::Tensor x = at::fft_rfft2(centred(picture.narrow(0, c, count)));
    const at::Tensor parts = at::view_as_real(x);
    const at::Tensor correlation = at::fft_irfft2(parts.square().sum(3), shape).div_(m);
    const at::Tensor smooth = at::real(at::fft_rfft2(correlation.mul_(fade_)));
    const at::Tensor root = (smooth.clamp_min(0) + least_power).sqrt_();
    const at::Tensor error = root - goal_.narrow(0, c, count);
    sum += (error.square() * weight_).sum().item<double>() * scale_;
    // Back the same way, by the chain rule: ∂/∂S, ∂/∂correlation, ∂/∂|X|², ∂/∂x.
    const at::Tensor of_smooth = (error / root).mul_(smooth > 0);
    const at::Tensor of_correlation = at::fft_irfft2(of_smooth, shape).mul_(fade_);
    const at::Tensor of_power = at::real(at::fft_rfft2(of_correlation));
    parts.mul_(of_power.unsqueeze(3));
    gradient.narrow(0, c, count).add_(at::fft_irfft2(x, shape), weight * scale_ * 2);
  }
  return sum;
}

VariationTerm::VariationTerm(const at::Tensor& exemplar, Tile wraps) : wraps_(wraps) {
  const at::Tensor variation = total_variation(exemplar, Tile::none);
  inverse_ = at::where(variation > 1e-3, 1 / variation, at::zeros_like(variation));
}

double VariationTerm::add(const at::Tensor& picture, double weight, std::uint64_t,
                          at::Tensor& gradient) const {
  return add_gradient(picture, weight, gradient, [&](const at::Tensor& x) {
    const at::Tensor ratio = total_variation(x, wraps_) * inverse_;
    return at::where(inverse_ > 0, (ratio - 1).square(), at::zeros_like(ratio)).mean();
  });
}

}  // namespace gramloom::neural
