#pragma once

#include <cstdint>
#include <vector>

namespace gramloom::neural {

/// Row-major vectors of one length.
struct Vectors {
  std::int64_t count = 0, dimensions = 0;
  std::vector<float> values;

  Vectors() = default;
  Vectors(std::int64_t count_, std::int64_t dimensions_)
      : count(count_),
        dimensions(dimensions_),
        values(static_cast<std::size_t>(count_ * dimensions_)) {}
  float* at(std::int64_t i) { return values.data() + i * dimensions; }
  const float* at(std::int64_t i) const { return values.data() + i * dimensions; }
};

/// For each query its nearest references, `neighbours` of each, the least cost first.
struct Neighbours {
  std::int64_t neighbours = 0;
  std::vector<std::int32_t> reference;
  std::vector<float> cost;
};

/// Puts a reference among the `neighbours` of one query, of which `costs` and `nearest` are the
/// lists, in place of the last: costs rise, of equal ones the reference that was there comes first.
inline void insert_neighbour(float cost, std::int32_t reference, std::int64_t neighbours,
                             float* costs, std::int32_t* nearest) {
  std::int64_t i = neighbours - 1;
  for (; i > 0 && costs[i - 1] > cost; --i) {
    costs[i] = costs[i - 1];
    nearest[i] = nearest[i - 1];
  }
  costs[i] = cost;
  nearest[i] = reference;
}

/// Reference r costs a query q: offset_r − 2 scale q·r. With offset_r = scale² r² + price_r this is
/// |q − scale r|² + price_r − q². All are tried. The same bytes for any number of threads.
Neighbours nearest_references(const Vectors& queries, const Vectors& references,
                              const std::vector<float>& offsets, float scale,
                              std::int64_t neighbours);

}  // namespace gramloom::neural
