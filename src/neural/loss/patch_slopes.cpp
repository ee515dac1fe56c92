#include "neural/loss/patch_slopes.h"

#include <memory>

#include "core/threads.h"
#include "neural/loss/multiply.h"
#include "neural/loss/patch_lines.h"
#include "neural/openmp.h"

namespace gramloom::neural {

namespace {

// Positions whose patches are worked on at once: few enough for the cache of a core.
constexpr std::int64_t slopes_at_once = 768;

// Rows of positions are shared out, at least a patch's height to each share, so that what a share
// adds reaches no further than into the next one; on an axis that wraps, that of the last one is
// the first. Their number is even, or 1.
struct Shares {
  std::int64_t rows, count;

  Shares(const PatchPositions& p)
      : rows(p.rows), count(std::max<std::int64_t>(1, p.rows / p.side / 2 * 2)) {}
  std::int64_t begin(std::int64_t share) const { return share * rows / count; }
};

// Some positions: whole rows, or a part of one.
struct Piece {
  std::int64_t y, rows, x, columns;
  std::int64_t count() const { return rows * columns; }
};

// Calls f(piece) for all positions of rows `begin` to `end`.
template <class F>
void for_each_position(const PatchPositions& p, std::int64_t begin, std::int64_t end, F&& f) {
  const std::int64_t parts = (p.columns + slopes_at_once - 1) / slopes_at_once;
  const std::int64_t rows = std::max<std::int64_t>(1, slopes_at_once / p.columns);
  for (std::int64_t y = begin; y < end; y += rows)
    for (std::int64_t part = 0; part < parts; ++part) {
      const std::int64_t x = part * p.columns / parts;
      f(Piece{y, std::min(rows, end - y), x, (part + 1) * p.columns / parts - x});
    }
}

// Calls f(first pixel in the picture, first value in `patches`, count) for all runs of values:
// patches are (taps, positions).
template <class F>
void for_each_line(const PatchPositions& p, const Piece& piece, F&& f) {
  for (std::int64_t row = 0; row < piece.rows; ++row) {
    std::int64_t line = row * piece.columns;
    for_each_tap(p, piece.y + row, piece.x, [&](std::int64_t from, std::int64_t column) {
      for_each_piece(p.width, column, piece.columns,
                     [&](std::int64_t first, std::int64_t place, std::int64_t count) {
                       f(from + first, line + place, count);
                     });
      line += piece.count();
    });
  }
}

}  // namespace

void add_slopes(
    const at::Tensor& picture, const at::Tensor& filters, Tile wraps,
    const std::function<void(std::int64_t filter, std::span<float> products)>& to_slopes,
    at::Tensor& gradient) {
  const PatchPositions p(picture, filters.size(2), wraps);
  const Shares shares(p);
  const at::Tensor weights = filters.contiguous();
  const float *source = picture.data_ptr<float>(), *filter = weights.data_ptr<float>();
  float* target = gradient.data_ptr<float>();
  const auto values = [](std::int64_t count) {
    return std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(count));
  };
  const auto add_share = [&](std::int64_t share) {
    const auto patches = values(p.taps() * slopes_at_once),
               products = values(filters.size(0) * slopes_at_once);
    for_each_position(p, shares.begin(share), shares.begin(share + 1), [&](const Piece& piece) {
      const std::int64_t count = piece.count();
      for_each_line(p, piece, [&](std::int64_t from, std::int64_t to, std::int64_t some) {
        std::copy_n(source + from, some, patches.get() + to);
      });
      multiply('N', Matrix<const float>{filter, p.taps()},
               Matrix<const float>{patches.get(), count}, Matrix<float>{products.get(), count},
               filters.size(0), count, p.taps());
      for (std::int64_t f = 0; f < filters.size(0); ++f)
        to_slopes(f, {products.get() + f * count, static_cast<std::size_t>(count)});
      multiply('T', Matrix<const float>{filter, p.taps()},
               Matrix<const float>{products.get(), count}, Matrix<float>{patches.get(), count},
               p.taps(), count, filters.size(0));
      for_each_line(p, piece, [&](std::int64_t to, std::int64_t from, std::int64_t some) {
        for (std::int64_t i = 0; i < some; ++i) target[to + i] += patches[from + i];
      });
    });
  };
  // No two of one parity add to the same row of the picture.
  for (std::int64_t parity = 0; parity < 2; ++parity)
    parallel_for((shares.count + 1 - parity) / 2, 1, [&](std::int64_t begin, std::int64_t end) {
      const InThisThread in_this_thread;
      for (std::int64_t i = begin; i < end; ++i) add_share(2 * i + parity);
    });
}

}  // namespace gramloom::neural
