#include "metrics/map_scores.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/error.h"
#include "core/portable_math.h"
#include "metrics/wasserstein.h"
#include "signal/histogram_match.h"

namespace gramloom {

namespace {

constexpr std::int64_t most_samples = 65536;

constexpr Metric list_for_maps[]{
    {"normal_angle", "maps",
     "how the surface leans: distance of the normals' angles to nine directions, in degrees",
     "from 0; 0 is equal", false, "Rabin, Peyre, Delon, Bernot 2011 (sliced, over directions)",
     "any arrangement: shuffled normals are perfect"},
    {"normal_bend", "maps",
     "how the surface bends: distance of the angles between neighbouring normals, in degrees",
     "from 0; 0 is equal", false, "", "shapes: it looks at two pixels at a time"},
    {"value_distance", "maps", "distance of the values of a map, in the exemplar's deviations",
     "from 0; 0 is equal", false, "Rabin, Peyre, Delon, Bernot 2011",
     "any arrangement: shuffled values are perfect"},
    {"step_distance", "maps",
     "distance of the differences between neighbouring values, in the exemplar's mean difference",
     "from 0; 0 is equal", false, "", "shapes: it looks at two pixels at a time"},
};

struct Vector {
  double x, y, z;
};

Vector normal_at(const Image& map, int x, int y) {
  const float* colour = map.at(x, y);
  const Vector n{2.0 * static_cast<double>(colour[0]) - 1, 2.0 * static_cast<double>(colour[1]) - 1,
                 2.0 * static_cast<double>(colour[2]) - 1};
  const double length = portable::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  return length > 0 ? Vector{n.x / length, n.y / length, n.z / length} : Vector{0, 0, 1};
}

// Degrees between unit vectors; by half the angle's sine, which is exact for small ones.
double angle(const Vector& a, const Vector& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  const double half = std::min(1.0, portable::sqrt(x * x + y * y + z * z) / 2);
  return 2 * portable::atan2(half, portable::sqrt(1 - half * half)) * 180 / portable::pi;
}

// What `value` gives for pixels of a map, spread over it; in ascending order.
std::vector<float> samples(const Image& map, const std::function<double(int x, int y)>& value) {
  std::vector<float> values;
  for (const std::int64_t i : spread_sample(std::int64_t{map.width} * map.height, most_samples))
    values.push_back(static_cast<float>(
        value(static_cast<int>(i % map.width), static_cast<int>(i / map.width))));
  return sorted_values(values);
}

// The pixel after this one; the last one's is the one before.
int next_to(int i, int count) { return i + 1 < count ? i + 1 : std::max(0, i - 1); }

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += double{value};
  return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<float>& values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const float value : values) sum += (double{value} - mean) * (double{value} - mean);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// A distance in units of what the exemplar has; of a flat map in the values' own.
double relative(double distance, double unit) { return unit > 1e-6 ? distance / unit : distance; }

std::array<Vector, 9> directions() {
  std::array<Vector, 9> all{};
  all[0] = {0, 0, 1};
  const double slant = portable::sqrt(0.5);
  for (int i = 0; i < 8; ++i)
    all[static_cast<std::size_t>(i) + 1] = {slant * portable::cos(i * portable::pi / 4),
                                            slant * portable::sin(i * portable::pi / 4), slant};
  return all;
}

double normal_angle(const Image& exemplar, const Image& map) {
  double sum = 0;
  for (const Vector& direction : directions()) {
    const auto angles = [&](const Image& of) {
      return samples(of, [&](int x, int y) { return angle(normal_at(of, x, y), direction); });
    };
    sum += quantile_distance(angles(exemplar), angles(map));
  }
  return sum / static_cast<double>(directions().size());
}

double normal_bend(const Image& exemplar, const Image& map) {
  const auto bends = [](const Image& of) {
    return samples(of, [&](int x, int y) {
      const Vector n = normal_at(of, x, y);
      return (angle(n, normal_at(of, next_to(x, of.width), y)) +
              angle(n, normal_at(of, x, next_to(y, of.height)))) /
             2;
    });
  };
  return quantile_distance(bends(exemplar), bends(map));
}

double value_distance(const Image& exemplar, const Image& map, int channel) {
  const auto values = [&](const Image& of) {
    return samples(of, [&](int x, int y) { return double{of.at(x, y)[channel]}; });
  };
  const auto own = values(exemplar);
  return relative(quantile_distance(own, values(map)), deviation_of(own));
}

double step_distance(const Image& exemplar, const Image& map, int channel) {
  const auto steps = [&](const Image& of) {
    return samples(of, [&](int x, int y) {
      const auto at = [&](int i, int j) { return double{of.at(i, j)[channel]}; };
      return (std::abs(at(next_to(x, of.width), y) - at(x, y)) +
              std::abs(at(x, next_to(y, of.height)) - at(x, y))) /
             2;
    });
  };
  const auto own = steps(exemplar);
  return relative(quantile_distance(own, steps(map)), mean_of(own));
}

}  // namespace

std::span<const Metric> map_metrics() { return list_for_maps; }

std::vector<std::pair<std::string_view, double>> score_map(const Image& exemplar, const Image& map,
                                                           MapKind kind) {
  if (exemplar.empty() || map.empty()) throw Error("a map to score is empty");
  if (exemplar.channels != map.channels)
    throw Error("the map has {} channels, the exemplar's {}: scores need the same number",
                map.channels, exemplar.channels);
  if (kind == MapKind::normal && map.channels >= 3)
    return {{"normal_angle", normal_angle(exemplar, map)},
            {"normal_bend", normal_bend(exemplar, map)}};
  double values = 0, steps = 0;
  for (int c = 0; c < map.channels; ++c) {
    values += value_distance(exemplar, map, c) / map.channels;
    steps += step_distance(exemplar, map, c) / map.channels;
  }
  return {{"value_distance", values}, {"step_distance", steps}};
}

}  // namespace gramloom
