#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/random.h"

namespace gramloom {

/// Where a neighbour lies from a pixel.
struct Offset {
  int x = 0;
  int y = 0;

  friend bool operator==(const Offset&, const Offset&) = default;
};

/// Which pixels of an image of symbols follow a context: the symbols at some offsets, the most
/// telling first. The positions are sorted by their contexts, so those that agree with a given
/// context, or with its first part, are neighbours in the table.
class ContextTable {
 public:
  static constexpr int unknown = 255;  // not a symbol: outside the image, or not there yet

  /// One symbol (0 to 254) a pixel, row-major; unknown ones are never drawn, and one must not be.
  ContextTable(const std::vector<std::uint8_t>& symbols, Size size, std::vector<Offset> offsets);

  const std::vector<Offset>& offsets() const { return offsets_; }

  /// A random position (y·width + x) among those whose symbols agree with as many of the first
  /// symbols of the context as any position does; it backs off to a shorter context at one that was
  /// never seen, or at an unknown one. symbol_at(offset) tells the context.
  template <class SymbolAt>
  std::uint32_t draw(const SymbolAt& symbol_at, Random& random) const {
    Range range{0, static_cast<std::uint32_t>(positions_.size())};
    for (std::size_t j = 0; j < offsets_.size(); ++j) {
      const int symbol = symbol_at(offsets_[j]);
      if (symbol == unknown) break;
      const Range narrower = narrow(range, j, static_cast<std::uint8_t>(symbol));
      if (narrower.begin == narrower.end) break;
      range = narrower;
    }
    return positions_[range.begin + random.below(range.end - range.begin)];
  }

 private:
  struct Range {
    std::uint32_t begin;
    std::uint32_t end;
  };
  /// The part of a range, within which symbols before the j-th agree, that has this j-th symbol.
  Range narrow(Range range, std::size_t j, std::uint8_t symbol) const;

  std::vector<Offset> offsets_;
  std::vector<std::uint32_t> positions_;            // sorted by context
  std::vector<std::vector<std::uint8_t>> symbols_;  // [j][rank]: at offset j from positions_[rank]
};

}  // namespace gramloom
