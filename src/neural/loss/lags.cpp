#include "neural/loss/lags.h"

#include <vector>

namespace gramloom::neural {

namespace {

// Sums of products of each channel with itself at every shift on a torus of that shape, which zeros
// fill up.
at::Tensor self_products(const at::Tensor& planes, const std::vector<std::int64_t>& shape) {
  const at::Tensor transformed = at::fft_rfft2(planes, shape);
  return at::fft_irfft2(at::real(transformed * at::conj(transformed)), shape);
}

}  // namespace

at::Tensor centred(const at::Tensor& planes) { return planes - planes.mean({1, 2}, true); }

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

at::Tensor on_torus(const at::Tensor& lags, Size size) {
  const std::int64_t rows = lags.size(1), half = (lags.size(2) + 1) / 2;
  at::Tensor torus = at::zeros({lags.size(0), size.height, size.width}, lags.options());
  const auto place = [&](const at::Tensor& some, std::int64_t first) {
    at::Tensor into = torus.narrow(1, first, some.size(1));
    into.narrow(2, 0, half).copy_(some.narrow(2, half - 1, half));
    into.narrow(2, size.width - half + 1, half - 1).copy_(some.narrow(2, 0, half - 1));
  };
  place(lags, 0);
  if (rows > 1) place(lags.narrow(1, 1, rows - 1).flip({1, 2}), size.height - rows + 1);
  return torus;
}

double inverse_of_sum(const at::Tensor& squares) {
  const double sum = squares.sum().item<double>();
  return sum > 0 ? 1 / sum : 0;
}

}  // namespace gramloom::neural
