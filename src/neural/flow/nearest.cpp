#include "neural/flow/nearest.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <oneapi/dnnl/dnnl.hpp>

#include "core/simd.h"
#include "core/threads.h"
#include "neural/openmp.h"

namespace gramloom::neural {

namespace {

constexpr std::int64_t queries_at_once = 96;
constexpr std::int64_t references_at_once = 512;  // their costs for those queries fit the cache
constexpr std::int64_t lanes = 16;

GRAMLOOM_SIMD void keep_least(const float* values, std::int64_t count, std::int64_t first,
                              std::int64_t neighbours, float* costs, std::int32_t* nearest) {
  for (std::int64_t i = 0; i < count; i += lanes) {
    const std::int64_t end = std::min(i + lanes, count);
    float least = std::numeric_limits<float>::max();
    if (end == i + lanes) {
      float lane[lanes];
      for (std::int64_t k = 0; k < lanes; ++k) lane[k] = values[i + k];
      for (std::int64_t half = lanes / 2; half > 0; half /= 2)
        for (std::int64_t k = 0; k < half; ++k) lane[k] = std::min(lane[k], lane[k + half]);
      least = lane[0];
    } else {
      for (std::int64_t k = i; k < end; ++k) least = std::min(least, values[k]);
    }
    if (least >= costs[neighbours - 1]) continue;
    for (std::int64_t k = i; k < end; ++k)
      if (values[k] < costs[neighbours - 1])
        insert_neighbour(values[k], static_cast<std::int32_t>(first + k), neighbours, costs,
                         nearest);
  }
}

}  // namespace

Neighbours nearest_references(const Vectors& queries, const Vectors& references,
                              const std::vector<float>& offsets, float scale,
                              std::int64_t neighbours) {
  neighbours = std::min(neighbours, references.count);
  // One dimension more adds the offset: a query has 1 there.
  const std::int64_t dimensions = queries.dimensions, inner = dimensions + 1;
  Vectors columns(inner, references.count);
  parallel_for(inner, 4, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t d = begin; d < end; ++d)
      for (std::int64_t r = 0; r < references.count; ++r)
        columns.at(d)[r] =
            d < dimensions ? references.at(r)[d] : offsets[static_cast<std::size_t>(r)];
  });
  Neighbours found{neighbours, {}, {}};
  found.reference.resize(static_cast<std::size_t>(queries.count * neighbours));
  found.cost.assign(found.reference.size(), std::numeric_limits<float>::max());
  const std::int64_t blocks = (queries.count + queries_at_once - 1) / queries_at_once;
  parallel_for(blocks, 1, [&](std::int64_t begin, std::int64_t end) {
    const InThisThread in_this_thread;
    const auto rows = std::make_unique_for_overwrite<float[]>(queries_at_once * inner);
    const auto costs =
        std::make_unique_for_overwrite<float[]>(queries_at_once * references_at_once);
    for (std::int64_t block = begin; block < end; ++block) {
      const std::int64_t first = block * queries_at_once;
      const std::int64_t count = std::min(queries_at_once, queries.count - first);
      for (std::int64_t q = 0; q < count; ++q) {
        const float* from = queries.at(first + q);
        float* to = rows.get() + q * inner;
        for (std::int64_t d = 0; d < dimensions; ++d) to[d] = -2 * scale * from[d];
        to[dimensions] = 1;
      }
      for (std::int64_t r = 0; r < references.count; r += references_at_once) {
        const std::int64_t some = std::min(references_at_once, references.count - r);
        dnnl::sgemm('N', 'N', count, some, inner, 1, rows.get(), inner, columns.values.data() + r,
                    references.count, 0, costs.get(), some);
        for (std::int64_t q = 0; q < count; ++q) {
          const auto at = static_cast<std::size_t>((first + q) * neighbours);
          keep_least(costs.get() + q * some, some, r, neighbours, found.cost.data() + at,
                     found.reference.data() + at);
        }
      }
    }
  });
  return found;
}

}  // namespace gramloom::neural
