#include "jobs/pose_blends.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gramloom {

namespace {

using Vector = std::vector<double>;

// Each number relative to its range.
Vector relative(const InferencePairs& pairs, const Vector& pose) {
  Vector place(pose.size(), 0.0);
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const double range = pairs.numbers[i].high - pairs.numbers[i].low;
    if (range > 0) place[i] = (pose[i] - pairs.numbers[i].low) / range;
  }
  return place;
}

double distance(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

// The pairs by their distance, the nearest first; of equal ones the earlier.
struct Neighbour {
  std::size_t pair;
  double distance;
};
std::vector<Neighbour> neighbours_of(const InferencePairs& pairs, const Vector& pose, int count) {
  const Vector place = relative(pairs, pose);
  std::vector<Neighbour> all;
  for (std::size_t i = 0; i < pairs.poses.size(); ++i)
    all.push_back({i, distance(place, relative(pairs, pairs.poses[i]))});
  std::stable_sort(all.begin(), all.end(),
                   [](const Neighbour& a, const Neighbour& b) { return a.distance < b.distance; });
  all.resize(std::min(all.size(), static_cast<std::size_t>(count)), {0, 0.0});
  return all;
}

// Solves a symmetric, positive system of `n` equations (Gauss).
Vector solved(Vector matrix, Vector right) {
  const std::size_t n = right.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t row = k + 1; row < n; ++row) {
      const double factor = matrix[row * n + k] / matrix[k * n + k];
      for (std::size_t column = k; column < n; ++column)
        matrix[row * n + column] -= factor * matrix[k * n + column];
      right[row] -= factor * right[k];
    }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t column = k + 1; column < n; ++column)
      right[k] -= matrix[k * n + column] * right[column];
    right[k] /= matrix[k * n + k];
  }
  return right;
}

// How much each neighbour counts in the value at `pose` of the plane that fits them best, where
// their own weights say how much each matters (Cleveland 1979).
void fit_linearly(const InferencePairs& pairs, const Vector& pose,
                  const std::vector<Neighbour>& near, Vector& weights) {
  const Vector place = relative(pairs, pose);
  const std::size_t n = place.size() + 1;
  std::vector<Vector> rows;
  Vector matrix(n * n, 0.0);
  for (std::size_t i = 0; i < near.size(); ++i) {
    const Vector other = relative(pairs, pairs.poses[near[i].pair]);
    Vector row{1.0};
    for (std::size_t k = 0; k + 1 < n; ++k) row.push_back(other[k] - place[k]);
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) matrix[a * n + b] += weights[i] * row[a] * row[b];
    rows.push_back(std::move(row));
  }
  for (std::size_t k = 0; k < n; ++k) matrix[k * n + k] += 1e-6;
  Vector wanted(n, 0.0);
  wanted[0] = 1;
  const Vector solution = solved(std::move(matrix), std::move(wanted));
  for (std::size_t i = 0; i < near.size(); ++i)
    weights[i] *= std::inner_product(rows[i].begin(), rows[i].end(), solution.begin(), 0.0);
}

Vector weights_of(const InferencePairs& pairs, const PoseBlend& blend, const Vector& pose,
                  const std::vector<Neighbour>& near) {
  Vector weights;
  for (const Neighbour& neighbour : near)
    weights.push_back(std::pow(std::max(neighbour.distance, 1e-6), -blend.power));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight /= sum;
  if (blend.linear) fit_linearly(pairs, pose, near, weights);
  return weights;
}

double squared_distance(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double difference = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

std::string PoseBlend::text() const {
  return fmt::format("{} of {} neighbours, by distance to the power of {:g}",
                     linear ? "linear fit" : "mean", neighbours, -power);
}

const Image& nearest_picture(const InferencePairs& pairs, const std::vector<double>& pose) {
  return pairs.pictures[neighbours_of(pairs, pose, 1).front().pair];
}

Image blended_picture(const InferencePairs& pairs, const PoseBlend& blend,
                      const std::vector<double>& pose) {
  const auto near = neighbours_of(pairs, pose, blend.neighbours);
  const Vector weights = weights_of(pairs, blend, pose, near);
  Image sum(pairs.pictures.front().size(), pairs.pictures.front().channels);
  for (std::size_t i = 0; i < near.size(); ++i) {
    const auto weight = static_cast<float>(weights[i]);
    const std::vector<float>& from = pairs.pictures[near[i].pair].pixels;
    for (std::size_t p = 0; p < from.size(); ++p) sum.pixels[p] += weight * from[p];
  }
  return sum;
}

Image mean_picture(const std::vector<Image>& pictures) {
  Image mean(pictures.front().size(), pictures.front().channels);
  for (const Image& picture : pictures)
    for (std::size_t p = 0; p < mean.pixels.size(); ++p) mean.pixels[p] += picture.pixels[p];
  for (float& value : mean.pixels) value /= static_cast<float>(pictures.size());
  return mean;
}

double relative_error(const std::vector<Image>& made, const std::vector<Image>& real,
                      const Image& mean) {
  double error = 0, variation = 0;
  for (std::size_t i = 0; i < real.size(); ++i) {
    error += squared_distance(made[i], real[i]);
    variation += squared_distance(mean, real[i]);
  }
  return variation > 0 ? std::sqrt(error / variation) : std::sqrt(error);
}

PoseBlend best_blend(const InferencePairs& pairs, const InferencePairs& others) {
  const Image mean = mean_picture(pairs.pictures);
  const int numbers = static_cast<int>(pairs.numbers.size());
  PoseBlend best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const PoseBlend& blend) {
    std::vector<Image> made;
    for (const auto& pose : others.poses) made.push_back(blended_picture(pairs, blend, pose));
    const double error = relative_error(made, others.pictures, mean);
    if (!(error < least)) return;
    least = error;
    best = blend;
  };
  for (const int neighbours : {2, 3, 4, 6, 8, 12, 16, 24, 40})
    for (const double power : {1.0, 2.0, 3.0, 4.0, 6.0}) {
      if (neighbours > static_cast<int>(pairs.poses.size())) continue;
      consider({neighbours, power, false});
      if (neighbours > numbers + 1) consider({neighbours, power, true});
    }
  return best;
}

}  // namespace gramloom
