#include "neural/network/rows.h"

#include <algorithm>

#include "neural/shares.h"

namespace gramloom::neural {

Rows hull(Rows a, Rows b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

Rows share_of(std::int64_t count, std::int64_t i, std::int64_t shares) {
  return {begin_of_share(count, i, shares), begin_of_share(count, i + 1, shares)};
}

HeldRows all_rows(const at::Tensor& picture) {
  return {picture, picture.size(0), {0, picture.size(1)}, picture.size(1)};
}

std::int64_t held_copy(std::int64_t row, Rows held, std::int64_t height) {
  return row + height * floor_divided(held.end - 1 - row, height) - held.begin;
}

Rows rows_behind(Rows wanted, std::int64_t height, Padding padding) {
  if (padding == Padding::circular) return wanted.count() < height ? wanted : Rows{0, height};
  // Reflected rows lie as deep inside as they would lie outside.
  if (padding == Padding::reflect)
    wanted = {std::min(wanted.begin, 2 * height - wanted.end), std::max(wanted.end, -wanted.begin)};
  return {std::clamp<std::int64_t>(wanted.begin, 0, height - 1),
          std::clamp<std::int64_t>(wanted.end, 1, height)};
}

at::Tensor take_rows(const HeldRows& known, Rows wanted, Padding padding) {
  const Rows held = known.rows;
  if (wanted == held) return known.data;  // the gradient of a share would be filled up with zeros
  const auto inside = [&](Rows rows) {
    return known.data.narrow(1, rows.begin - held.begin, rows.count());
  };
  if (wanted.begin >= held.begin && wanted.end <= held.end) return inside(wanted);
  if (padding == Padding::zero) {
    const Rows inner{std::max<std::int64_t>(wanted.begin, 0), std::min(wanted.end, known.height)};
    std::vector<std::int64_t> zeros(static_cast<std::size_t>(2 * (known.data.dim() - 2)), 0);
    zeros.insert(zeros.end(), {inner.begin - wanted.begin, wanted.end - inner.end});
    return at::constant_pad_nd(inside(inner), zeros);
  }
  std::vector<std::int64_t> from;
  for (std::int64_t row = wanted.begin; row < wanted.end; ++row)
    from.push_back(padding == Padding::circular
                       ? held_copy(row, held, known.height)
                       : source_of(row, known.height, padding) - held.begin);
  return known.data.index_select(1, at::tensor(from, at::kLong));
}

}  // namespace gramloom::neural
