#include "neural/loss/patches.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "core/error.h"
#include "core/threads.h"
#include "neural/loss/multiply.h"
#include "neural/openmp.h"

namespace gramloom::neural {

namespace {

// Where patches lie in a picture that was continued across the edges where it wraps.
struct Layout {
  std::int64_t channels, kernel, margin_y, margin_x;  // the margins lie below and to the right
  std::int64_t height, width;                         // positions
  // Rows of positions are shared out, at least a patch's height to each share, so that shares of
  // one parity never write to the same row of the picture. Of a share, a few rows are worked on at
  // once.
  std::int64_t rows_at_once, rows_of_share, shares;
  std::int64_t taps() const { return channels * kernel * kernel; }
  std::size_t values_at_once() const {
    return static_cast<std::size_t>(taps() * rows_at_once * width);
  }

  // Calls f(first row, rows) for all rows of a share, a few at a time.
  template <class F>
  void for_a_few_rows(std::int64_t share, F&& f) const {
    const std::int64_t end = std::min((share + 1) * rows_of_share, height);
    for (std::int64_t y = share * rows_of_share; y < end; y += rows_at_once)
      f(y, std::min(rows_at_once, end - y));
  }
};

Layout layout_of(const at::Tensor& planes, std::int64_t kernel, Tile wraps) {
  Layout l;
  l.channels = planes.size(0);
  l.kernel = kernel;
  l.margin_y = tiles_y(wraps) ? kernel - 1 : 0;
  l.margin_x = tiles_x(wraps) ? kernel - 1 : 0;
  l.height = planes.size(1) + l.margin_y - kernel + 1;
  l.width = planes.size(2) + l.margin_x - kernel + 1;
  if (l.height < 1 || l.width < 1)
    throw Error("a patch of {0}×{0} does not fit into a picture of {1}×{2}", kernel, planes.size(2),
                planes.size(1));
  constexpr std::int64_t positions = 1024;  // multiplied at once: few enough for the cache
  l.rows_at_once = std::max<std::int64_t>(1, positions / l.width);
  l.rows_of_share = (kernel + l.rows_at_once - 1) / l.rows_at_once * l.rows_at_once;
  l.shares = (l.height + l.rows_of_share - 1) / l.rows_of_share;
  return l;
}

// `planes` and its beginning once more below and to the right.
at::Tensor continued(const at::Tensor& planes, const Layout& l) {
  at::Tensor result = planes;
  const auto extend = [&](std::int64_t axis, std::int64_t margin) {
    const std::int64_t side = planes.size(axis);
    std::vector<at::Tensor> parts{result};
    for (std::int64_t left = margin; left > 0; left -= side)
      parts.push_back(result.narrow(axis, 0, std::min(left, side)));
    if (parts.size() > 1) result = at::cat(parts, axis);
  };
  extend(1, l.margin_y);
  extend(2, l.margin_x);
  return result.contiguous();
}

// Calls f(row of the picture, row of the patch matrix) for each tap of each of these rows.
template <class F>
void for_each_line(const Layout& l, std::int64_t first, std::int64_t rows, F&& f) {
  std::int64_t line = 0;
  for (std::int64_t c = 0; c < l.channels; ++c)
    for (std::int64_t ky = 0; ky < l.kernel; ++ky)
      for (std::int64_t kx = 0; kx < l.kernel; ++kx)
        for (std::int64_t y = 0; y < rows; ++y, ++line) f(c, first + y + ky, kx, line * l.width);
}

}  // namespace

at::Tensor project_patches(const at::Tensor& planes, const at::Tensor& filters, Tile wraps) {
  const Layout l = layout_of(planes, filters.size(2), wraps);
  const at::Tensor picture = continued(planes, l), weights = filters.contiguous();
  const std::int64_t directions = filters.size(0), positions = l.height * l.width;
  at::Tensor result = at::empty({directions, positions}, planes.options());
  AT_DISPATCH_FLOATING_TYPES(planes.scalar_type(), "project_patches", [&] {
    const scalar_t* source = picture.data_ptr<scalar_t>();
    const scalar_t* filter = weights.data_ptr<scalar_t>();
    scalar_t* target = result.data_ptr<scalar_t>();
    const std::int64_t plane = picture.stride(0), row = picture.stride(1);
    parallel_for(l.shares, 1, [&](std::int64_t begin, std::int64_t end) {
      const InThisThread in_this_thread;
      const auto patches = std::make_unique_for_overwrite<scalar_t[]>(l.values_at_once());
      for (std::int64_t s = begin; s < end; ++s)
        l.for_a_few_rows(s, [&](std::int64_t first, std::int64_t rows) {
          for_each_line(
              l, first, rows, [&](std::int64_t c, std::int64_t y, std::int64_t x, std::int64_t to) {
                std::copy_n(source + c * plane + y * row + x, l.width, patches.get() + to);
              });
          multiply('N', Matrix<const scalar_t>{filter, l.taps()},
                   Matrix<const scalar_t>{patches.get(), rows * l.width},
                   Matrix<scalar_t>{target + first * l.width, positions}, directions,
                   rows * l.width, l.taps());
        });
    });
  });
  return result;
}

void spread_patches(const at::Tensor& gradient, const at::Tensor& filters, Tile wraps,
                    at::Tensor& planes) {
  const Layout l = layout_of(planes, filters.size(2), wraps);
  const at::Tensor weights = filters.contiguous(), slopes = gradient.contiguous();
  at::Tensor sum = at::zeros({l.channels, planes.size(1) + l.margin_y, planes.size(2) + l.margin_x},
                             planes.options());
  AT_DISPATCH_FLOATING_TYPES(planes.scalar_type(), "spread_patches", [&] {
    const scalar_t* source = slopes.data_ptr<scalar_t>();
    const scalar_t* filter = weights.data_ptr<scalar_t>();
    scalar_t* target = sum.data_ptr<scalar_t>();
    const std::int64_t plane = sum.stride(0), row = sum.stride(1);
    // Shares overlap by less than one share: first the even ones, then the odd ones.
    for (std::int64_t parity = 0; parity < 2; ++parity)
      parallel_for((l.shares + 1 - parity) / 2, 1, [&](std::int64_t begin, std::int64_t end) {
        const InThisThread in_this_thread;
        const auto patches = std::make_unique_for_overwrite<scalar_t[]>(l.values_at_once());
        for (std::int64_t i = begin; i < end; ++i)
          l.for_a_few_rows(2 * i + parity, [&](std::int64_t first, std::int64_t rows) {
            multiply('T', Matrix<const scalar_t>{filter, l.taps()},
                     Matrix<const scalar_t>{source + first * l.width, l.height * l.width},
                     Matrix<scalar_t>{patches.get(), rows * l.width}, l.taps(), rows * l.width,
                     filters.size(0));
            for_each_line(l, first, rows,
                          [&](std::int64_t c, std::int64_t y, std::int64_t x, std::int64_t from) {
                            scalar_t* out = target + c * plane + y * row + x;
                            const scalar_t* in = patches.get() + from;
                            for (std::int64_t k = 0; k < l.width; ++k) out[k] += in[k];
                          });
          });
      });
  });
  // What lies in the margins belongs to the beginning.
  const auto fold = [&](std::int64_t axis, std::int64_t margin) {
    const std::int64_t side = planes.size(axis);
    at::Tensor folded = sum.narrow(axis, 0, side);
    for (std::int64_t at = side; at < side + margin; at += side) {
      const std::int64_t length = std::min(side, side + margin - at);
      folded.narrow(axis, 0, length).add_(sum.narrow(axis, at, length));
    }
    sum = folded;
  };
  fold(1, l.margin_y);
  fold(2, l.margin_x);
  planes.add_(sum);
}

}  // namespace gramloom::neural
