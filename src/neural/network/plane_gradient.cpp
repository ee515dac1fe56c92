#include "neural/network/plane_gradient.h"

#include <algorithm>

#include "core/threads.h"
#include "neural/openmp.h"

namespace gramloom::neural {

namespace {

constexpr std::int64_t rows_at_once = 8;

// target[i] += source[i]
void accumulate(float* target, const float* source, std::int64_t count) {
  for (std::int64_t i = 0; i < count; ++i) target[i] += source[i];
}

// Adds what rows [first, first + rows) of the maps give to `result`, whose row 0 is row `first`.
void add_rows(const at::Tensor& upstream, const at::Tensor& by_tap, std::int64_t kernel,
              std::int64_t dilation, std::int64_t first, std::int64_t rows, at::Tensor& result) {
  const std::int64_t width = upstream.size(2);
  // (outputs, rows · width), then (inputs · kernel · kernel, rows · width)
  const at::Tensor outputs =
      upstream.narrow(1, first, rows).permute({0, 3, 1, 2}).reshape({-1, rows * width});
  const at::Tensor taps = at::mm(by_tap, outputs.narrow(0, 0, by_tap.size(1)));
  const float* tap = taps.data_ptr<float>();
  float* target = result.data_ptr<float>();
  const std::int64_t plane = result.stride(0), line = result.stride(1);
  for (std::int64_t i = 0; i < result.size(0); ++i)
    for (std::int64_t ky = 0; ky < kernel; ++ky)
      for (std::int64_t kx = 0; kx < kernel; ++kx)
        for (std::int64_t row = 0; row < rows; ++row, tap += width)
          accumulate(target + i * plane + (row + ky * dilation) * line + kx * dilation, tap, width);
}

}  // namespace

at::Tensor plane_gradient(const at::Tensor& upstream, const at::Tensor& weights,
                          std::int64_t dilation) {
  const std::int64_t height = upstream.size(1), width = upstream.size(2);
  const std::int64_t outputs = weights.size(0), inputs = weights.size(1), kernel = weights.size(2);
  const std::int64_t span = (kernel - 1) * dilation;
  const at::Tensor by_tap = weights.reshape({outputs, -1}).t().contiguous();

  // Rows are shared out, each share into a tensor of its own, which overlap by `span` rows. The
  // shares do not depend on the number of threads.
  const std::int64_t rows_of_share = std::max<std::int64_t>(4 * rows_at_once, 2 * span);
  const std::int64_t shares = (height + rows_of_share - 1) / rows_of_share;
  std::vector<at::Tensor> results(static_cast<std::size_t>(shares));
  parallel_for(shares, 1, [&](std::int64_t begin, std::int64_t end) {
    const InThisThread in_this_thread;
    for (std::int64_t s = begin; s < end; ++s) {
      const std::int64_t last = std::min(height, (s + 1) * rows_of_share);
      at::Tensor own =
          at::zeros({inputs, last - s * rows_of_share + span, width + span}, upstream.options());
      for (std::int64_t y = s * rows_of_share; y < last; y += rows_at_once) {
        at::Tensor rest =
            own.narrow(1, y - s * rows_of_share, own.size(1) - (y - s * rows_of_share));
        add_rows(upstream, by_tap, kernel, dilation, y, std::min(rows_at_once, last - y), rest);
      }
      results[static_cast<std::size_t>(s)] = own;
    }
  });
  at::Tensor result = at::zeros({inputs, height + span, width + span}, upstream.options());
  for (std::int64_t s = 0; s < shares; ++s) {
    const at::Tensor& own = results[static_cast<std::size_t>(s)];
    result.narrow(1, s * rows_of_share, own.size(1)).add_(own);
  }
  return result;
}

}  // namespace gramloom::neural
