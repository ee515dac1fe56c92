#include "neural/flow/memory.h"

#include <algorithm>
#include <array>

namespace gramloom::neural {

namespace {

constexpr std::array<std::array<int, 2>, 8> beside{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

std::int64_t cells(int side) { return (side + patch_stride - 1) / patch_stride; }

struct Offer {
  std::int64_t query;
  PatchPlace place;
};

std::vector<Offer> offers(const Sources& sources, const Search& search, double share,
                          Random random) {
  const std::int64_t columns = cells(sources.size.width), rows = cells(sources.size.height);
  const std::int64_t old_rows = sources.shifts.size(0), old_columns = sources.shifts.size(1);
  const float* shifts = sources.shifts.data_ptr<float>();
  const int factor = sources.of_coarser ? 2 : 1;
  std::vector<Offer> result;
  for (std::int64_t row = 0; row < rows; ++row)
    for (std::int64_t column = 0; column < columns; ++column) {
      if (random.uniform() >= share) continue;
      const std::int64_t query = row * columns + column;
      const PatchPlace own = search.queries[static_cast<std::size_t>(query)];
      const auto offer = [&](std::int64_t r, std::int64_t c) {
        r = (r / factor + old_rows) % old_rows;
        c = (c / factor + old_columns) % old_columns;
        const float* shift = shifts + (r * old_columns + c) * 2;
        const PatchPlace place{own.x + factor * static_cast<int>(shift[0]),
                               own.y + factor * static_cast<int>(shift[1])};
        const Size places = search.prices.places;
        if (place.x >= 0 && place.y >= 0 && place.x < places.width && place.y < places.height &&
            search.usable(place))
          result.push_back({query, place});
      };
      offer(row, column);
      const auto [dx, dy] = beside[random.below(beside.size())];
      offer(row + dy * factor + old_rows * factor, column + dx * factor + old_columns * factor);
    }
  return result;
}

}  // namespace

at::Tensor sources_of(Size size, const std::vector<PatchPlace>& queries,
                      const std::vector<PatchPlace>& references, const Neighbours& nearest) {
  at::Tensor shifts = at::empty({cells(size.height), cells(size.width), 2}, at::kFloat);
  float* to = shifts.data_ptr<float>();
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const auto first = q * static_cast<std::size_t>(nearest.neighbours);
    const PatchPlace from = references[static_cast<std::size_t>(nearest.reference[first])];
    to[2 * q] = static_cast<float>(from.x - queries[q].x);
    to[2 * q + 1] = static_cast<float>(from.y - queries[q].y);
  }
  return shifts;
}

void remember(const Sources& sources, const Search& search, double share, Random random,
              std::vector<PatchPlace>& references, Neighbours& found) {
  const std::vector<Offer> offered = offers(sources, search, share, random);
  constexpr std::size_t at_once = 1 << 16;  // of millions in a large picture
  Vectors vectors;
  const auto k = static_cast<std::size_t>(found.neighbours);
  for (std::size_t i = 0; i < offered.size(); ++i) {
    if (i % at_once == 0) {
      std::vector<PatchPlace> places;
      for (std::size_t j = i; j < std::min(i + at_once, offered.size()); ++j)
        places.push_back(offered[j].place);
      vectors = search.references(places);
    }
    const float* v = vectors.at(static_cast<std::int64_t>(i % at_once));
    const float* q = search.of_picture.at(offered[i].query);
    float norm = 0, product = 0;
    for (std::int64_t d = 0; d < vectors.dimensions; ++d) {
      if (d < search.dimensions) norm += v[d] * v[d];
      product += v[d] * q[d];
    }
    const PatchPlace place = offered[i].place;
    const float price = search.prices.values[place.y * search.prices.places.width + place.x];
    const float cost = search.scale * search.scale * norm + price - 2 * search.scale * product;
    const std::size_t first = static_cast<std::size_t>(offered[i].query) * k;
    if (cost >= found.cost[first + k - 1]) continue;
    const bool there = std::ranges::any_of(
        found.reference.begin() + static_cast<std::ptrdiff_t>(first),
        found.reference.begin() + static_cast<std::ptrdiff_t>(first + k), [&](std::int32_t r) {
          const PatchPlace other = references[static_cast<std::size_t>(r)];
          return other.x == place.x && other.y == place.y;
        });
    if (there) continue;
    insert_neighbour(cost, static_cast<std::int32_t>(references.size()), found.neighbours,
                     found.cost.data() + first, found.reference.data() + first);
    references.push_back(place);
  }
}

}  // namespace gramloom::neural
