#include "signal/patch_field.h"

#include <algorithm>
#include <limits>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom {

namespace {

/// Rows of a field that are scanned in order; other bands are scanned at the same time.
constexpr int band_rows = 16;

constexpr int lanes = 8;
typedef float Lanes __attribute__((vector_size(lanes * sizeof(float)), aligned(4), may_alias));
constexpr int row_lanes = field_patch * field_features / lanes;

__attribute__((always_inline)) inline float sum_of(const Lanes (&sums)[row_lanes]) {
  const Lanes sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

/// Squared distance of two patches, whose rows are `a_row` and `b_row` values apart; at least
/// `limit`, but not all of it, when the rows looked at come to that. Most do in the first two.
__attribute__((always_inline)) inline float squared_distance(const float* a, std::ptrdiff_t a_row,
                                                             const float* b, std::ptrdiff_t b_row,
                                                             float limit) {
  float total = 0;
  for (int half = 0; half < 2; ++half) {
    Lanes sums[row_lanes] = {};
    float with_half = 0;
    for (int y = 0; y < field_patch / 2; ++y, a += a_row, b += b_row) {
      const Lanes* av = reinterpret_cast<const Lanes*>(a);
      const Lanes* bv = reinterpret_cast<const Lanes*>(b);
      for (int k = 0; k < row_lanes; ++k) {
        const Lanes d = av[k] - bv[k];
        sums[k] += d * d;
      }
      if (y % 2 == 0) continue;
      with_half = total + sum_of(sums);
      if (with_half >= limit) return with_half;
    }
    total = with_half;
  }
  return total;
}

struct Search {
  const Image& canvas;
  const Image& exemplar;
  const PatchPenalty& penalty;
  Size origins;
  std::ptrdiff_t canvas_row, exemplar_row;

  Search(const Image& canvas_, const Image& exemplar_, const PatchPenalty& penalty_)
      : canvas(canvas_),
        exemplar(exemplar_),
        penalty(penalty_),
        origins(patch_origins(exemplar_.size())),
        canvas_row(std::ptrdiff_t{canvas_.width} * field_features),
        exemplar_row(std::ptrdiff_t{exemplar_.width} * field_features) {}

  bool contains(PatchOrigin o) const {
    return o.x >= 0 && o.y >= 0 && o.x < origins.width && o.y < origins.height;
  }
};

/// The best origin so far of the patch at (x, y).
struct Best {
  PatchOrigin origin;
  float distance = 0;
  float cost = 0;
};

__attribute__((always_inline)) inline void try_origin(const Search& search, int x, int y,
                                                      PatchOrigin origin, Best& best) {
  const float penalty = search.penalty.of_origin[search.penalty.index(origin)] +
                        search.penalty.of_shift[search.penalty.shift(x, y, origin)];
  const float limit = best.cost - penalty;
  if (limit <= 0) return;
  const float distance =
      squared_distance(search.canvas.at(x, y), search.canvas_row,
                       search.exemplar.at(origin.x, origin.y), search.exemplar_row, limit);
  if (distance < limit) best = {origin, distance, distance + penalty};
}

/// A whole number within `radius` of `centre` and in [0, count).
inline int near(int centre, int radius, int count, std::uint32_t bits16) {
  const int low = std::max(0, centre - radius), high = std::min(count - 1, centre + radius);
  return low + static_cast<int>((static_cast<std::uint32_t>(high - low + 1) * bits16) >> 16);
}

GRAMLOOM_SIMD void improve_band(PatchField& field, const std::vector<PatchOrigin>& before,
                                const Search& search, int first, int last, int direction, int tries,
                                Random random) {
  const int width = field.size.width, height = field.size.height;
  const auto suggestion = [&](int x, int y, int dx, int dy) {
    x += dx;
    y += dy;
    if (tiles_x(field.tile)) x = (x + width) % width;
    if (tiles_y(field.tile)) y = (y + height) % height;
    if (x < 0 || y < 0 || x >= width || y >= height) return PatchOrigin{-1, -1};
    const auto& nearest = y >= first && y < last ? field.nearest : before;
    const PatchOrigin origin = nearest[field.index(x, y)];
    return PatchOrigin{origin.x - dx, origin.y - dy};
  };
  const int rows = last - first;
  for (int i = 0; i < rows; ++i) {
    const int y = direction > 0 ? first + i : last - 1 - i;
    for (int k = 0; k < width; ++k) {
      const int x = direction > 0 ? k : width - 1 - k;
      const std::size_t index = field.index(x, y);
      Best best{field.nearest[index], 0, std::numeric_limits<float>::infinity()};
      try_origin(search, x, y, best.origin, best);
      for (const PatchOrigin o : {suggestion(x, y, -direction, 0), suggestion(x, y, 0, -direction)})
        if (search.contains(o) && o != best.origin) try_origin(search, x, y, o, best);
      int radius = std::max(search.origins.width, search.origins.height);
      for (int t = 0; t < tries && radius > 0; ++t, radius /= 3) {
        const std::uint32_t bits = random.bits();
        try_origin(search, x, y,
                   {near(best.origin.x, radius, search.origins.width, bits & 0xFFFF),
                    near(best.origin.y, radius, search.origins.height, bits >> 16)},
                   best);
      }
      field.nearest[index] = best.origin;
      field.distance[index] = best.distance;
    }
  }
}

GRAMLOOM_SIMD void search_all_of_band(PatchField& field, const Search& search, int first,
                                      int last) {
  for (int y = first; y < last; ++y)
    for (int x = 0; x < field.size.width; ++x) {
      const std::size_t index = field.index(x, y);
      Best best{field.nearest[index], 0, std::numeric_limits<float>::infinity()};
      try_origin(search, x, y, best.origin, best);
      for (int v = 0; v < search.origins.height; ++v)
        for (int u = 0; u < search.origins.width; ++u) try_origin(search, x, y, {u, v}, best);
      field.nearest[index] = best.origin;
      field.distance[index] = best.distance;
    }
}

}  // namespace

Size patch_origins(Size image) {
  return {image.width - field_patch + 1, image.height - field_patch + 1};
}

PatchField blank_field(Size size, Tile tile) {
  const auto count = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  return {size, tile, std::vector<PatchOrigin>(count), std::vector<float>(count)};
}

PatchField random_field(Size size, Tile tile, Size origins, Random random) {
  PatchField field = blank_field(size, tile);
  for (PatchOrigin& origin : field.nearest)
    origin = {static_cast<int>(random.below(static_cast<std::uint32_t>(origins.width))),
              static_cast<int>(random.below(static_cast<std::uint32_t>(origins.height)))};
  return field;
}

void improve(PatchField& field, const Image& canvas, const Image& exemplar,
             const PatchPenalty& penalty, int pass, int tries, Random random) {
  const Search search(canvas, exemplar, penalty);
  const std::vector<PatchOrigin> before = field.nearest;
  parallel_for(field.size.height, band_rows, [&](std::int64_t first, std::int64_t last) {
    improve_band(field, before, search, static_cast<int>(first), static_cast<int>(last),
                 pass % 2 == 0 ? 1 : -1, tries, random.stream(static_cast<std::uint64_t>(first)));
  });
}

void search_all(PatchField& field, const Image& canvas, const Image& exemplar,
                const PatchPenalty& penalty) {
  const Search search(canvas, exemplar, penalty);
  parallel_for(field.size.height, 1, [&](std::int64_t first, std::int64_t last) {
    search_all_of_band(field, search, static_cast<int>(first), static_cast<int>(last));
  });
}

}  // namespace gramloom
