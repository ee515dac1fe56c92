#include "classic/context_table.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace gramloom {

ContextTable::ContextTable(const std::vector<std::uint8_t>& symbols, Size size,
                           std::vector<Offset> offsets)
    : offsets_(std::move(offsets)), positions_(symbols.size()) {
  const auto symbol_at = [&](std::uint32_t position, Offset offset) {
    const int x = static_cast<int>(position) % size.width + offset.x;
    const int y = static_cast<int>(position) / size.width + offset.y;
    if (x < 0 || x >= size.width || y < 0 || y >= size.height) return std::uint8_t{unknown};
    return symbols[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                   static_cast<std::size_t>(x)];
  };
  std::iota(positions_.begin(), positions_.end(), 0u);
  std::erase_if(positions_, [&](std::uint32_t p) { return symbols[p] == unknown; });
  // Counting sorts from the last symbol of the context to the first: each keeps the order of the
  // one before.
  std::vector<std::uint32_t> sorted(positions_.size());
  for (auto offset = offsets_.rbegin(); offset != offsets_.rend(); ++offset) {
    std::array<std::uint32_t, 257> start{};
    for (const auto p : positions_) ++start[symbol_at(p, *offset) + 1u];
    std::partial_sum(start.begin(), start.end(), start.begin());
    for (const auto p : positions_) sorted[start[symbol_at(p, *offset)]++] = p;
    positions_.swap(sorted);
  }
  for (const Offset offset : offsets_) {
    auto& column = symbols_.emplace_back(positions_.size());
    std::transform(positions_.begin(), positions_.end(), column.begin(),
                   [&](std::uint32_t p) { return symbol_at(p, offset); });
  }
}

ContextTable::Range ContextTable::narrow(Range range, std::size_t j, std::uint8_t symbol) const {
  const auto column = symbols_[j].begin();
  const auto [begin, end] = std::equal_range(column + range.begin, column + range.end, symbol);
  return {static_cast<std::uint32_t>(begin - column), static_cast<std::uint32_t>(end - column)};
}

}  // namespace gramloom
