#include <algorithm>
#include <cmath>
#include <numeric>

#include "classic/pixel_features.h"
#include "core/threads.h"

namespace gramloom::pixel {

namespace {

constexpr int leaf_size = 48;
constexpr int partitions = 3;

using Indices = std::vector<std::int32_t>;
struct Span {
  std::size_t begin, end;
};

/// Splits `order` into leaves: each range of it is halved by a random hyperplane until it is small.
std::vector<Span> partition(const std::vector<Feature>& features, Indices& order, Random random) {
  std::iota(order.begin(), order.end(), 0);
  std::vector<Span> leaves{{0, order.size()}};
  std::vector<float> position(order.size());
  while (leaves.front().end - leaves.front().begin > leaf_size) {
    std::vector<Span> halves(2 * leaves.size());
    const Random here = random.stream(leaves.size());
    parallel_for(static_cast<std::int64_t>(leaves.size()), 1, [&](std::int64_t l, std::int64_t) {
      const auto i = static_cast<std::size_t>(l);
      const auto [begin, end] = leaves[i];
      Random direction_random = here.stream(i);
      Feature direction;
      for (float& value : direction) value = direction_random.normal();
      for (std::size_t j = begin; j < end; ++j) {
        const Feature& feature = features[static_cast<std::size_t>(order[j])];
        float dot = 0;
        for (std::size_t d = 0; d < feature_size; ++d) dot += direction[d] * feature[d];
        position[static_cast<std::size_t>(order[j])] = dot;
      }
      const std::size_t middle = begin + (end - begin) / 2;
      const auto at = [&](std::size_t j) { return order.begin() + static_cast<std::ptrdiff_t>(j); };
      std::nth_element(at(begin), at(middle), at(end), [&](std::int32_t a, std::int32_t b) {
        const float pa = position[static_cast<std::size_t>(a)];
        const float pb = position[static_cast<std::size_t>(b)];
        return pa != pb ? pa < pb : a < b;
      });
      halves[2 * i] = {begin, middle};
      halves[2 * i + 1] = {middle, end};
    });
    leaves = std::move(halves);
  }
  return leaves;
}

/// The lists under construction, and how a sample enters one.
struct Lists {
  const Level& level;
  const std::vector<Feature>& features;
  std::size_t count;  // others kept for each sample
  int apart;
  Indices others;                // [sample][count], near to far; -1 where not found yet
  std::vector<float> distances;  // as others

  bool far_enough(std::int32_t a, std::int32_t b) const {
    const Point p = level.point(a), q = level.point(b);
    return std::abs(p.x - q.x) >= apart || std::abs(p.y - q.y) >= apart;
  }

  void insert(std::int32_t sample, std::int32_t other, float distance) {
    const std::size_t first = static_cast<std::size_t>(sample) * count;
    std::size_t place = count;
    if (distance > distances[first + count - 1]) return;
    for (std::size_t i = 0; i < count; ++i) {
      if (others[first + i] == other) return;
      if (place == count && distance < distances[first + i]) place = i;
    }
    for (std::size_t i = count; i-- > place + 1;) {
      others[first + i] = others[first + i - 1];
      distances[first + i] = distances[first + i - 1];
    }
    if (place < count) {
      others[first + place] = other;
      distances[first + place] = distance;
    }
  }

  /// Samples that may not be used are like none, and none is like them.
  bool may_pair(std::int32_t a, std::int32_t b) const {
    return far_enough(a, b) && level.may_use(a) && level.may_use(b);
  }

  void search_leaf(const Indices& order, Span leaf) {
    for (std::size_t i = leaf.begin; i < leaf.end; ++i)
      for (std::size_t j = i + 1; j < leaf.end; ++j) {
        const std::int32_t a = order[i], b = order[j];
        if (!may_pair(a, b)) continue;
        const float distance = squared_distance(features[static_cast<std::size_t>(a)],
                                                features[static_cast<std::size_t>(b)]);
        insert(a, b, distance);
        insert(b, a, distance);
      }
  }

  /// Tries what the 4 neighbours' lists of `before` suggest.
  void propagate(std::int32_t sample, const Indices& before) {
    const Point p = level.point(sample);
    for (const Point d : {Point{-1, 0}, Point{1, 0}, Point{0, -1}, Point{0, 1}}) {
      const Point q{p.x + d.x, p.y + d.y};
      if (!level.contains(q)) continue;
      const std::size_t first = static_cast<std::size_t>(level.index(q)) * count;
      for (std::size_t i = 0; i < count; ++i) {
        if (before[first + i] < 0) break;
        const Point suggestion = level.point(before[first + i]);
        const Point other{suggestion.x - d.x, suggestion.y - d.y};
        if (!level.contains(other)) continue;
        const std::int32_t index = level.index(other);
        if (may_pair(sample, index))
          insert(sample, index,
                 squared_distance(features[static_cast<std::size_t>(sample)],
                                  features[static_cast<std::size_t>(index)]));
      }
    }
  }
};

}  // namespace

int distance_apart(const Level& level) {
  return std::max(1, std::min(level.colours.width, level.colours.height) / 20);
}

std::vector<Point> similar_samples(const Level& level, const std::vector<Feature>& features,
                                   int count, int apart, Random random) {
  const auto samples = static_cast<std::size_t>(level.count());
  const auto width = static_cast<std::size_t>(count);
  const auto kept = width - 1;
  Lists lists{level,
              features,
              kept,
              apart,
              Indices(samples * kept, -1),
              std::vector<float>(samples * kept, INFINITY)};
  if (kept > 0) {
    Indices order(samples);
    for (std::uint64_t i = 0; i < partitions; ++i) {
      const auto leaves = partition(features, order, random.stream(i));
      parallel_for(static_cast<std::int64_t>(leaves.size()), 16,
                   [&](std::int64_t begin, std::int64_t end) {
                     for (auto l = begin; l < end; ++l)
                       lists.search_leaf(order, leaves[static_cast<std::size_t>(l)]);
                   });
    }
    const Indices before = lists.others;
    parallel_for(level.count(), 1024, [&](std::int64_t begin, std::int64_t end) {
      for (auto s = begin; s < end; ++s) lists.propagate(static_cast<std::int32_t>(s), before);
    });
  }

  std::vector<Point> result(samples * width);
  for (std::size_t s = 0; s < samples; ++s)
    for (std::size_t i = 0; i < width; ++i) {
      const std::int32_t other = i > 0 ? lists.others[s * kept + i - 1] : -1;
      result[s * width + i] = level.point(other >= 0 ? other : static_cast<std::int32_t>(s));
    }
  return result;
}

}  // namespace gramloom::pixel
