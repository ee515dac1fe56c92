#include "classic/markov.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "classic/context_table.h"
#include "classic/known_pixels.h"
#include "classic/palette.h"
#include "signal/united.h"

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
  /// `known`: symbols of pixels that are not to be drawn, unknown elsewhere; empty: there are none.
  Canvas(Size size, Tile tile, const std::vector<std::uint8_t>& symbols,
         std::vector<std::uint8_t> known)
      : size_(size),
        tile_(tile),
        symbols_(symbols),
        known_(std::move(known)),
        sources_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height),
                 undrawn) {}

  std::uint32_t source(int x, int y) const { return sources_[index(x, y)]; }

  bool is_known(int x, int y) const {
    return !known_.empty() && known_[index(x, y)] != ContextTable::unknown;
  }
  /// Whether a known pixel lies within seam_width.
  bool near_known(int x, int y) const {
    if (known_.empty()) return false;
    for (int dy = -seam_width; dy <= seam_width; ++dy)
      for (int dx = -seam_width; dx <= seam_width; ++dx) {
        int near_x = x + dx, near_y = y + dy;
        if (wrap(near_x, near_y) && is_known(near_x, near_y)) return true;
      }
    return false;
  }

  void draw(int x, int y, const ContextTable& table, Random& random) {
    if (is_known(x, y)) return;
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

  /// Brings a position around on axes that tile; false where it lies beyond an edge.
  bool wrap(int& x, int& y) const {
    if (tiles_x(tile_)) x = wrapped(x, size_.width);
    if (tiles_y(tile_)) y = wrapped(y, size_.height);
    return x >= 0 && y >= 0 && x < size_.width && y < size_.height;
  }

  int symbol_at(int x, int y) const {
    if (!wrap(x, y)) return ContextTable::unknown;
    if (is_known(x, y)) return known_[index(x, y)];
    const std::uint32_t source = sources_[index(x, y)];
    return source == undrawn ? ContextTable::unknown : symbols_[source];
  }

  Size size_;
  Tile tile_;
  const std::vector<std::uint8_t>& symbols_;
  std::vector<std::uint8_t> known_;
  std::vector<std::uint32_t> sources_;
};

/// The usable pixels of an exemplar, as one row.
Image only_usable(const Exemplar& exemplar) {
  std::vector<const float*> pixels;
  for (int y = 0; y < exemplar.mask.height; ++y)
    for (int x = 0; x < exemplar.mask.width; ++x)
      if (*exemplar.mask.at(x, y) > 0.5f) pixels.push_back(exemplar.image.at(x, y));
  Image result(static_cast<int>(pixels.size()), 1, exemplar.image.channels);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    std::copy_n(pixels[i], result.channels, result.at(static_cast<int>(i), 0));
  return result;
}

/// Symbols of the exemplar's pixels, and of the target's known ones on a canvas with a margin.
struct Symbols {
  std::vector<std::uint8_t> exemplar, known;
};

Symbols find_symbols(const Exemplar& exemplar, const Target& target, int colours, int left, int top,
                     Random random) {
  const Palette palette = learn_palette(
      exemplar.mask.empty() ? exemplar.image : only_usable(exemplar), colours, random);
  Symbols result{nearest_colours(exemplar.image, palette), {}};
  for (std::size_t i = 0; i < exemplar.mask.pixels.size(); ++i)
    if (exemplar.mask.pixels[i] <= 0.5f) result.exemplar[i] = ContextTable::unknown;
  if (target.known.empty()) return result;
  const auto known = nearest_colours(target.known, palette);
  const int width = target.size.width + left;
  result.known.assign(
      static_cast<std::size_t>(width) * static_cast<std::size_t>(target.size.height + top),
      ContextTable::unknown);
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto x = static_cast<int>(i) % target.size.width;
    const auto y = static_cast<int>(i) / target.size.width;
    if (target.mask.pixels[i] <= 0.5f)
      result.known[static_cast<std::size_t>(y + top) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(x + left)] = known[i];
  }
  return result;
}

bool near_an_end(int i, int length) { return i < seam_width || i >= length - seam_width; }

}  // namespace

Texture synthesise(const MarkovParams& params, const Request& request, const Control& control) {
  check_request<MarkovParams>(request);
  const United united(request);
  const Exemplar& material = united.exemplar();
  const Image& exemplar = material.image;
  const Target& target = request.target;
  // Rows of their own need no care where the top meets the bottom.
  const bool rows_depend = params.neighbourhood == MarkovNeighbourhood::causal;
  const bool seam_x = tiles_x(target.tile), seam_y = tiles_y(target.tile) && rows_depend;
  const int left = tiles_x(target.tile) ? 0 : margin;
  const int top = tiles_y(target.tile) || !rows_depend ? 0 : margin;
  const Size size{target.size.width + left, target.size.height + top};
  const bool fills = !target.known.empty();
  const int rounds = (seam_x || seam_y || fills) && params.order > 0 ? seam_rounds : 0;
  const std::int64_t steps = std::int64_t{1 + rounds} * size.height;
  control.step(0, steps);

  auto [symbols, known] =
      find_symbols(material, target, params.colours, left, top, request.random.stream(0));
  const auto offsets = context_offsets(params);
  Canvas canvas(size, target.tile, symbols, std::move(known));
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
          else if ((seam_x && near_an_end(x, size.width)) || canvas.near_known(x, y))
            canvas.draw(x, y, around_x, row);
        }
        control.step(std::int64_t{round} * size.height + y + 1, steps);
      }
  }

  const auto any = static_cast<int>(
      std::ranges::find_if(symbols, [](int s) { return s != ContextTable::unknown; }) -
      symbols.begin());  // where a known pixel would come from doesn't matter
  SourceMap source(target.size);
  for (int y = 0; y < target.size.height; ++y)
    for (int x = 0; x < target.size.width; ++x) {
      if (canvas.is_known(x + left, y + top)) {
        *source.at(x, y) = united.source(any % exemplar.width, any / exemplar.width);
        continue;
      }
      const auto drawn = static_cast<int>(canvas.source(x + left, y + top));
      *source.at(x, y) = united.source(drawn % exemplar.width, drawn / exemplar.width);
    }
  Texture texture = texture_of(std::move(source), request.exemplars);
  keep_known(texture.image, target);
  return texture;
}

Cost estimate(const MarkovParams& params, const RequestSize& request) {
  check_request<MarkovParams>(request);
  const int channels = request.exemplars.front().channels;
  double in = 0;
  for (const ExemplarSize& exemplar : request.exemplars)
    in += static_cast<double>(exemplar.size.width) * exemplar.size.height;
  const double out =
      static_cast<double>(request.size.width + margin) * (request.size.height + margin);
  return {4 * channels * (in + out) + in * (9 + 3 * params.order) + (4 + sizeof(Source)) * out,
          {.serial = in * (1e-8 * params.order + 1e-9 * params.colours * channels) +
                     out * 5e-8 * (1 + params.order)}};
}

}  // namespace gramloom
