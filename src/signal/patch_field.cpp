#include "signal/patch_field.h"

#include <algorithm>
#include <span>

#include "core/error.h"
#include "core/simd.h"
#include "core/threads.h"
#include "signal/patch_distance.h"
#include "signal/patch_sketch.h"

namespace gramloom {

namespace {

/// Rows of a field that are scanned in order; other bands are scanned at the same time.
constexpr int band_rows = 16;

/// What a pass looks at. Most of what it tries is ruled out by sketches.
struct Search {
  const Image& canvas;
  const Image& exemplar;
  SketchScale scale;
  const std::vector<PatchSketch>& exemplar_sketches;
  const PatchPenalty* penalty = nullptr;  // null: none
  const unsigned char* usable = nullptr;  // origins; null: all
  const std::vector<Image>* source_guide = nullptr;
  const PatchGuide* guide = nullptr;  // null: none
  Size origins = patch_origins(exemplar.size());
  std::ptrdiff_t canvas_row = std::ptrdiff_t{canvas.width} * field_features;
  std::ptrdiff_t exemplar_row = std::ptrdiff_t{exemplar.width} * field_features;

  bool contains(PatchOrigin o) const {
    return o.x >= 0 && o.y >= 0 && o.x < origins.width && o.y < origins.height;
  }
  std::size_t index(PatchOrigin o) const {
    return static_cast<std::size_t>(o.y) * static_cast<std::size_t>(origins.width) +
           static_cast<std::size_t>(o.x);
  }
  bool is_usable(PatchOrigin o) const { return !usable || usable[index(o)] != 0; }
};

/// The best origin so far of the patch at (x, y).
struct Best {
  PatchOrigin origin;
  float distance = 0;
  float cost = 0;
};

GRAMLOOM_INLINE float penalty_of(const Search& search, int x, int y, PatchOrigin origin) {
  if (!search.penalty) return 0;
  const PatchOrigin shift = search.penalty->shift(x, y, origin);
  return search.penalty->of_origin[search.index(origin)] +
         search.penalty->of_shift.at(shift.x, shift.y);
}

/// Weighted squared difference in the guide. Not inlined: most searches have none.
GRAMLOOM_SIMD float guide_distance(const Search& search, int x, int y, PatchOrigin origin,
                                   std::size_t patch) {
  float sum = 0;
  for (std::size_t plane = 0; plane < search.guide->wanted.size(); ++plane)
    sum +=
        squared_distance(search.guide->wanted[plane].at(x, y), search.canvas_row,
                         (*search.source_guide)[plane].at(origin.x, origin.y), search.exemplar_row);
  return search.guide->weight[patch] * sum;
}

/// What the origin that the patch has from the pass before costs now.
GRAMLOOM_INLINE void keep_origin(const Search& search, int x, int y, std::size_t patch,
                                 Best& best) {
  best.distance =
      squared_distance(search.canvas.at(x, y), search.canvas_row,
                       search.exemplar.at(best.origin.x, best.origin.y), search.exemplar_row);
  if (search.guide) best.distance += guide_distance(search, x, y, best.origin, patch);
  best.cost = best.distance + penalty_of(search, x, y, best.origin);
}

GRAMLOOM_INLINE void try_origin(const Search& search, int x, int y, std::size_t patch,
                                PatchOrigin origin, Best& best) {
  if (!search.is_usable(origin)) return;
  float distance =
      squared_distance(search.canvas.at(x, y), search.canvas_row,
                       search.exemplar.at(origin.x, origin.y), search.exemplar_row, best.cost);
  if (distance >= best.cost) return;  // as most do, without a look at penalties far away in memory
  if (search.guide) {
    distance += guide_distance(search, x, y, origin, patch);
    if (distance >= best.cost) return;
  }
  const float penalty = penalty_of(search, x, y, origin);
  if (distance < best.cost - penalty) best = {origin, distance, distance + penalty};
}

typedef std::uint32_t FourBits __attribute__((vector_size(16), aligned(4), may_alias));

/// Whole numbers within `radius` of `centre` and in [0, count).
GRAMLOOM_INLINE Four near(int centre, Four radius, int count, FourBits bits16) {
  const Four zero{}, last = zero + (count - 1);
  Four low = centre - radius, high = centre + radius;
  low = low < zero ? zero : low;
  high = high > last ? last : high;
  const FourBits count_within = reinterpret_cast<FourBits>(high - low + 1);
  return low + reinterpret_cast<Four>((count_within * bits16) >> 16);
}

/// Random origins about one.
struct FourOrigins {
  Four x, y;
};
GRAMLOOM_INLINE FourOrigins draw(Size origins, PatchOrigin around, Four radius, FourBits bits) {
  return {near(around.x, radius, origins.width, bits & 0xFFFF),
          near(around.y, radius, origins.height, bits >> 16)};
}

/// Where the sketches of origins lie among all.
GRAMLOOM_INLINE Four places(const FourOrigins& origins, int width) {
  return origins.y * width + origins.x;
}

/// Has the sketches brought from memory that try_four() will look at if a patch's best so far stays
/// its best.
GRAMLOOM_INLINE void prefetch_four(const Search& search, PatchOrigin around, Four radius,
                                   FourBits bits) {
  const Four at = places(draw(search.origins, around, radius, bits), search.origins.width);
  for (int t = 0; t < 4; ++t) __builtin_prefetch(search.exemplar_sketches.data() + at[t]);
}

/// Tries the first `count` of four random origins, each about the best so far.
GRAMLOOM_INLINE void try_four(const Search& search, int x, int y, std::size_t index,
                              const PatchSketch& patch, Four radius, FourBits bits, int count,
                              Best& best) {
  const PatchSketch* sketches = search.exemplar_sketches.data();
  PatchOrigin around;
  FourOrigins drawn;
  Four difference;
  int telling = 0;
  const auto look = [&]() __attribute__((always_inline)) {
    around = best.origin;
    drawn = draw(search.origins, around, radius, bits);
    const Four at = places(drawn, search.origins.width);
    difference =
        differences(patch, sketches[at[0]], sketches[at[1]], sketches[at[2]], sketches[at[3]]);
    telling = telling_difference(best.cost, search.scale);
  };
  look();
  for (int t = 0; t < count; ++t) {
    if (difference[t] >= telling) continue;
    try_origin(search, x, y, index, {drawn.x[t], drawn.y[t]}, best);
    if (best.origin != around) look();
  }
}

/// Rows [first, last) of a field, the sketches of their patches, and, from before the pass, the row
/// that the first of them to be scanned looks at.
struct Band {
  int first, last;
  const PatchSketch* sketches;
  const SmallOrigin* before;
};

GRAMLOOM_SIMD void improve_band(PatchField& field, const Band& band, const Search& search,
                                int direction, int tries, Random random) {
  const auto [first, last, sketches, before] = band;
  const int width = field.size.width, height = field.size.height;
  const auto suggestion = [&](int x, int y, int dx, int dy) {
    x += dx;
    y += dy;
    if (tiles_x(field.tile)) x = (x + width) % width;
    if (tiles_y(field.tile)) y = (y + height) % height;
    if (x < 0 || y < 0 || x >= width || y >= height || !field.looks_for(field.index(x, y)))
      return PatchOrigin{-1, -1};
    const PatchOrigin origin =
        y >= first && y < last ? field.nearest[field.index(x, y)] : before[x];
    return PatchOrigin{origin.x - dx, origin.y - dy};
  };
  const int rows = last - first;
  std::vector<int> radius;  // and some zeros: four are read at a time
  for (int r = std::max(search.origins.width, search.origins.height);
       static_cast<int>(radius.size()) < tries && r > 0; r /= 3)
    radius.push_back(r);
  tries = static_cast<int>(radius.size());
  radius.resize(radius.size() + 4);
  std::vector<std::uint32_t> bits(static_cast<std::size_t>(width * tries + 4));
  for (int i = 0; i < rows; ++i) {
    const int y = direction > 0 ? first + i : last - 1 - i;
    random.fill(std::span(bits).first(static_cast<std::size_t>(width * tries)));
    for (int k = 0; k < width; ++k) {
      const int x = direction > 0 ? k : width - 1 - k;
      const std::size_t index = field.index(x, y);
      if (!field.looks_for(index)) continue;
      Best best{.origin = field.nearest[index]};
      keep_origin(search, x, y, index, best);
      for (const PatchOrigin o : {suggestion(x, y, -direction, 0), suggestion(x, y, 0, -direction)})
        if (search.contains(o) && o != best.origin) try_origin(search, x, y, index, o, best);
      const PatchSketch& patch = sketches[index - field.index(0, first)];
      if (k + 1 < width)
        prefetch_four(search, field.nearest[field.index(x + direction, y)],
                      *reinterpret_cast<const Four*>(radius.data()),
                      *reinterpret_cast<const FourBits*>(bits.data() + (k + 1) * tries));
      for (int t = 0; t < tries; t += 4)
        try_four(search, x, y, index, patch, *reinterpret_cast<const Four*>(radius.data() + t),
                 *reinterpret_cast<const FourBits*>(bits.data() + k * tries + t),
                 std::min(4, tries - t), best);
      field.nearest[index] = best.origin;
      field.distance[index] = best.distance;
    }
  }
}

GRAMLOOM_SIMD void search_all_of_band(PatchField& field, const Band& band, const Search& search) {
  const auto [first, last, sketches, before] = band;
  const int width = search.origins.width;
  for (int y = first; y < last; ++y)
    for (int x = 0; x < field.size.width; ++x) {
      const std::size_t index = field.index(x, y);
      if (!field.looks_for(index)) continue;
      const PatchSketch& patch = sketches[index - field.index(0, first)];
      Best best{.origin = field.nearest[index]};
      keep_origin(search, x, y, index, best);
      int telling = telling_difference(best.cost, search.scale);
      const auto consider = [&](int u, int v, int difference) __attribute__((always_inline)) {
        if (difference >= telling) return;
        const float cost = best.cost;
        try_origin(search, x, y, index, {u, v}, best);
        if (best.cost < cost) telling = telling_difference(best.cost, search.scale);
      };
      const PatchSketch* sketch = search.exemplar_sketches.data();
      for (int v = 0; v < search.origins.height; ++v) {
        int u = 0;
        for (; u + 4 <= width; u += 4, sketch += 4) {
          const Four difference = differences(patch, sketch[0], sketch[1], sketch[2], sketch[3]);
          for (int t = 0; t < 4; ++t) consider(u + t, v, difference[t]);
        }
        for (; u < width; ++u, ++sketch)
          consider(u, v, differences(patch, *sketch, *sketch, *sketch, *sketch)[0]);
      }
      field.nearest[index] = best.origin;
      field.distance[index] = best.distance;
    }
}

/// For each band the row of the field next to it that a pass in this direction looks at.
std::vector<SmallOrigin> rows_before(const PatchField& field, int direction) {
  const int height = field.size.height, bands = (height + band_rows - 1) / band_rows;
  std::vector<SmallOrigin> rows(field.index(0, bands));
  for (int band = 0; band < bands; ++band) {
    const int beside =
        direction > 0 ? band * band_rows - 1 : std::min(height, (band + 1) * band_rows);
    std::copy_n(field.nearest.data() + field.index(0, (beside + height) % height), field.size.width,
                rows.data() + field.index(0, band));
  }
  return rows;
}

void improve(PatchField& field, const Search& search, int pass, int tries, Random random) {
  const int direction = pass % 2 == 0 ? 1 : -1, height = field.size.height;
  const std::vector<SmallOrigin> before = rows_before(field, direction);
  parallel_for(height, band_rows, [&](std::int64_t begin, std::int64_t end) {
    const auto first = static_cast<int>(begin), last = static_cast<int>(end);
    const auto sketches = sketch_patches(search.canvas, search.scale, first, last);
    const Band band{first, last, sketches.data(),
                    before.data() + field.index(0, first / band_rows)};
    improve_band(field, band, search, direction, tries,
                 random.stream(static_cast<std::uint64_t>(first)));
  });
}

void search_all(PatchField& field, const Search& search) {
  parallel_for(field.size.height, 1, [&](std::int64_t first, std::int64_t last) {
    const auto sketches = sketch_patches(search.canvas, search.scale, static_cast<int>(first),
                                         static_cast<int>(last));
    search_all_of_band(
        field, {static_cast<int>(first), static_cast<int>(last), sketches.data(), nullptr}, search);
  });
}

Search search_of(const Image& canvas, const PatchGuide& guide, const PatchSource& source,
                 const PatchPenalty* penalty) {
  return {canvas,        source.features,
          source.scale,  source.sketches,
          penalty,       source.usable.empty() ? nullptr : source.usable.data(),
          &source.guide, guide.wanted.empty() ? nullptr : &guide};
}

}  // namespace

void check_origins(Size exemplar) {
  constexpr int most = SmallOrigin::most + 1;
  if (std::max(exemplar.width, exemplar.height) > most)
    throw Error("an exemplar of {}×{} is too large to compare its patches: at most {} a side",
                exemplar.width, exemplar.height, most);
}

PatchField blank_field(Size size, Tile tile) {
  const auto count = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  return {size, tile, std::vector<SmallOrigin>(count), std::vector<float>(count)};
}

PatchField random_field(Size size, Tile tile, Size origins, Random random) {
  PatchField field = blank_field(size, tile);
  for (SmallOrigin& origin : field.nearest) {
    const auto x = static_cast<int>(random.below(static_cast<std::uint32_t>(origins.width)));
    origin = {x, static_cast<int>(random.below(static_cast<std::uint32_t>(origins.height)))};
  }
  return field;
}

void improve(PatchField& field, const Image& canvas, const Image& exemplar,
             const PatchPenalty& penalty, int pass, int tries, Random random) {
  check_origins(exemplar.size());
  const SketchScale scale = sketch_scale(exemplar);
  const std::vector<PatchSketch> sketches = sketch_patches(exemplar, scale);
  improve(field, {canvas, exemplar, scale, sketches, &penalty}, pass, tries, random);
}

void improve(PatchField& field, const Image& canvas, const PatchGuide& guide,
             const PatchSource& source, const PatchPenalty* penalty, int pass, int tries,
             Random random) {
  improve(field, search_of(canvas, guide, source, penalty), pass, tries, random);
}

void search_all(PatchField& field, const Image& canvas, const Image& exemplar,
                const PatchPenalty& penalty) {
  check_origins(exemplar.size());
  const SketchScale scale = sketch_scale(exemplar);
  const std::vector<PatchSketch> sketches = sketch_patches(exemplar, scale);
  search_all(field, {canvas, exemplar, scale, sketches, &penalty});
}

void search_all(PatchField& field, const Image& canvas, const PatchGuide& guide,
                const PatchSource& source, const PatchPenalty* penalty) {
  search_all(field, search_of(canvas, guide, source, penalty));
}

}  // namespace gramloom
