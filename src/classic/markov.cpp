#include "classic/markov.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "classic/context_table.h"
#include "classic/palette.h"

namespace gramloom {

namespace {

constexpr int margin = 16;     // pixels that a chain gets to settle in
constexpr int seam_width = 8;  // pixels on either side of a seam that are drawn again
constexpr int seam_rounds = 8;

/// The context, nearest first.
std::vector<Offset> context_offsets(const MarkovParams& params) {
  std::vector<Offset> offsets;
  if (params.neighbourhood == MarkovNeighbourhood::row) {
    for (int k = 1; k <= params.order; ++k) offsets.push_back({-k, 0});
    return offsets;
  }
  constexpr int reach = 6;  // holds more than 32 offsets
  for (int y = 0; y >= -reach; --y)
    for (int x = -reach; x <= reach; ++x)
      if (y < 0 || x < 0) offsets.push_back({x, y});
  std::stable_sort(offsets.begin(), offsets.end(), [](Offset a, Offset b) {
    return a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
  });
  offsets.resize(static_cast<std::size_t>(params.order));
  return offsets;
}

/// The context and its mirror image, nearest first; of equally near ones those across the seam.
std::vector<Offset> both_sides(const std::vector<Offset>& offsets, bool seam_is_vertical) {
  std::vector<Offset> both;
  for (const Offset o : offsets) {
    both.push_back(o);
    both.push_back({-o.x, -o.y});
  }
  const auto distance = [&](Offset o) {
    const int across = std::abs(seam_is_vertical ? o.x : o.y);
    return 100 * (o.x * o.x + o.y * o.y) - across;
  };
  std::stable_sort(both.begin(), both.end(),
                   [&](Offset a, Offset b) { return distance(a) < distance(b); });
  return both;
}

/// The image in the making: for each pixel the exemplar's position that it was drawn from.
class Canvas {
 public:
  Canvas(Size size, Tile tile, const std::vector<std::uint8_t>& symbols)
      : size_(size),
        tile_(tile),
        symbols_(symbols),
        sources_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height),
                 undrawn) {}

  std::uint32_t source(int x, int y) const { return sources_[index(x, y)]; }

  void draw(int x, int y, const ContextTable& table, Random& random) {
    sources_[index(x, y)] =
        table.draw([&](Offset offset) { return symbol_at(x + offset.x, y + offset.y); }, random);
  }

 private:
  static constexpr std::uint32_t undrawn = 0xFFFFFFFFu;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
           static_cast<std::size_t>(x);
  }
  static int wrapped(int i, int length) { return ((i % length) + length) % length; }

  int symbol_at(int x, int y) const {
    if (x < 0 || x >= size_.width) {
      if (!tiles_x(tile_)) return ContextTable::unknown;
      x = wrapped(x, size_.width);
    }
    if (y < 0 || y >= size_.height) {
      if (!tiles_y(tile_)) return ContextTable::unknown;
      y = wrapped(y, size_.height);
    }
    const std::uint32_t source = sources_[index(x, y)];
    return source == undrawn ? ContextTable::unknown : symbols_[source];
  }

  Size size_;
  Tile tile_;
  const std::vector<std::uint8_t>& symbols_;
  std::vector<std::uint32_t> sources_;
};

bool near_an_end(int i, int length) { return i < seam_width || i >= length - seam_width; }

}  // namespace

Texture synthesise(const MarkovParams& params, const Request& request, const Control& control) {
  check_request<MarkovParams>(request);
  const Image& exemplar = request.exemplars.front().image;
  const Target& target = request.target;
  // Rows of their own need no care where the top meets the bottom.
  const bool rows_depend = params.neighbourhood == MarkovNeighbourhood::causal;
  const bool seam_x = tiles_x(target.tile), seam_y = tiles_y(target.tile) && rows_depend;
  const int left = tiles_x(target.tile) ? 0 : margin;
  const int top = tiles_y(target.tile) || !rows_depend ? 0 : margin;
  const Size size{target.size.width + left, target.size.height + top};
  const int rounds = (seam_x || seam_y) && params.order > 0 ? seam_rounds : 0;
  const std::int64_t steps = std::int64_t{1 + rounds} * size.height;
  control.step(0, steps);

  const Palette palette = learn_palette(exemplar, params.colours, request.random.stream(0));
  const auto symbols = nearest_colours(exemplar, palette);
  const auto offsets = context_offsets(params);
  Canvas canvas(size, target.tile, symbols);
  const ContextTable preceding(symbols, exemplar.size(), offsets);
  for (int y = 0; y < size.height; ++y) {
    Random row = request.random.stream(1).stream(static_cast<std::uint64_t>(y));
    for (int x = 0; x < size.width; ++x) canvas.draw(x, y, preceding, row);
    control.step(y + 1, steps);
  }
  if (rounds > 0) {
    const ContextTable around_x(symbols, exemplar.size(), both_sides(offsets, true));
    const ContextTable around_y(symbols, exemplar.size(), both_sides(offsets, false));
    for (int round = 1; round <= rounds; ++round)
      for (int y = 0; y < size.height; ++y) {
        Random row = request.random.stream(static_cast<std::uint64_t>(1 + round))
                         .stream(static_cast<std::uint64_t>(y));
        for (int x = 0; x < size.width; ++x) {
          if (seam_y && near_an_end(y, size.height))
            canvas.draw(x, y, around_y, row);
          else if (seam_x && near_an_end(x, size.width))
            canvas.draw(x, y, around_x, row);
        }
        control.step(std::int64_t{round} * size.height + y + 1, steps);
      }
  }

  SourceMap source(target.size);
  for (int y = 0; y < target.size.height; ++y)
    for (int x = 0; x < target.size.width; ++x) {
      const auto drawn = static_cast<int>(canvas.source(x + left, y + top));
      *source.at(x, y) = {drawn % exemplar.width, drawn / exemplar.width};
    }
  return texture_of(std::move(source), request.exemplars);
}

Cost estimate(const MarkovParams& params, const RequestSize& request) {
  check_request<MarkovParams>(request);
  const Size exemplar = request.exemplars.front().size;
  const int channels = request.exemplars.front().channels;
  const double in = static_cast<double>(exemplar.width) * exemplar.height;
  const double out =
      static_cast<double>(request.size.width + margin) * (request.size.height + margin);
  return {4 * channels * (in + out) + in * (9 + 3 * params.order) + (4 + sizeof(Source)) * out,
          in * (1e-8 * params.order + 1e-9 * params.colours * channels) +
              out * 4e-8 * (1 + params.order)};
}

}  // namespace gramloom
