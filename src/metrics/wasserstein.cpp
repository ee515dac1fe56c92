#include "metrics/wasserstein.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"
#include "core/simd.h"
#include "core/threads.h"
#include "metrics/components.h"
#include "signal/quantile.h"
#include "signal/sort.h"

namespace gramloom {

namespace {

constexpr std::uint64_t direction_seed = 0x736c69636573;
constexpr int patch_side = 7;
constexpr int patch_scales = 3;
constexpr int patch_directions = 64;

/// Makes the mean of every `step`th value from `first` on 0.
void remove_mean(std::vector<double>& values, int first, int step) {
  const int length = static_cast<int>(values.size());
  double sum = 0;
  for (int i = first; i < length; i += step) sum += values[static_cast<std::size_t>(i)];
  for (int i = first; i < length; i += step)
    values[static_cast<std::size_t>(i)] -= sum * step / length;
}

/// `count` unit vectors of `length`, so that value v of direction d is at [v · count + d].
/// Those of a patch are of mean 0 in each of `components` interleaved ones; else `components` is 0.
std::vector<float> random_directions(int length, int count, int components) {
  std::vector<float> result(static_cast<std::size_t>(length) * static_cast<std::size_t>(count));
  for (int d = 0; d < count; ++d) {
    Random random = Random(direction_seed, 2).stream(static_cast<std::uint64_t>(d));
    std::vector<double> v;
    for (int i = 0; i < length; ++i) v.push_back(double{random.normal()});
    for (int c = 0; c < components; ++c) remove_mean(v, c, components);
    const double squares = std::inner_product(v.begin(), v.end(), v.begin(), 0.0);
    for (int i = 0; i < length; ++i)
      result[static_cast<std::size_t>(i) * static_cast<std::size_t>(count) +
             static_cast<std::size_t>(d)] =
          static_cast<float>(v[static_cast<std::size_t>(i)] / std::sqrt(squares));
  }
  return result;
}

/// Projections of the patch at (x, y) on all directions.
GRAMLOOM_SIMD void project_patch(const Image& image, int x, int y, const float* directions,
                                 float* result) {
  float sums[patch_directions] = {};
  const int row_values = patch_side * image.channels;
  for (int dy = 0; dy < patch_side; ++dy) {
    const float* in = image.at(x, y + dy);
    for (int i = 0; i < row_values; ++i, directions += patch_directions)
      for (int d = 0; d < patch_directions; ++d) sums[d] += in[i] * directions[d];
  }
  std::copy_n(sums, patch_directions, result);
}

void sort_all(Projections& projections) {
  parallel_for(
      static_cast<std::int64_t>(projections.size()), 1, [&](std::int64_t begin, std::int64_t end) {
        Sorter sorter;
        for (auto d = static_cast<std::size_t>(begin); d < static_cast<std::size_t>(end); ++d)
          sorter.sort(projections[d]);
      });
}

Projections projections_at_scale(const Image& image, const std::vector<float>& directions) {
  const int columns = image.width - patch_side + 1, rows = image.height - patch_side + 1;
  const auto places = spread_sample(std::int64_t{columns} * rows, 16384);
  Projections result(patch_directions, std::vector<float>(places.size()));
  parallel_for(
      static_cast<std::int64_t>(places.size()), 256, [&](std::int64_t begin, std::int64_t end) {
        float projected[patch_directions];
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          project_patch(image, static_cast<int>(places[i] % columns),
                        static_cast<int>(places[i] / columns), directions.data(), projected);
          for (std::size_t d = 0; d < patch_directions; ++d) result[d][i] = projected[d];
        }
      });
  sort_all(result);
  return result;
}

double deviation(const std::vector<float>& values) {
  double sum = 0, squares = 0;
  for (const float v : values) {
    sum += double{v};
    squares += double{v} * double{v};
  }
  const auto n = static_cast<double>(values.size());
  return std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)));
}

}  // namespace

std::vector<std::int64_t> spread_sample(std::int64_t count, std::int64_t wanted) {
  const std::int64_t taken = std::min(count, wanted);
  std::vector<std::int64_t> result;
  Random random(direction_seed, 1);
  for (std::int64_t i = 0; i < taken; ++i) {
    const std::int64_t begin = count * i / taken, end = count * (i + 1) / taken;
    result.push_back(begin + random.below(static_cast<std::uint32_t>(end - begin)));
  }
  return result;
}

double quantile_distance(const std::vector<float>& a, const std::vector<float>& b) {
  const std::size_t count = std::min(a.size(), b.size());
  const Quantiles of_a(a, count), of_b(b, count);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += std::abs(of_a(i) - of_b(i));
  return sum / static_cast<double>(count);
}

std::vector<Projections> patch_projections(const Image& components) {
  const auto directions = random_directions(patch_side * patch_side * components.channels,
                                            patch_directions, components.channels);
  std::vector<Projections> scales;
  Image image = components;
  while (true) {
    scales.push_back(projections_at_scale(image, directions));
    if (scales.size() == patch_scales) break;
    image = smoothly_halved(image);
    if (std::min(image.width, image.height) < patch_side) break;
  }
  return scales;
}

double patch_wasserstein(const std::vector<Projections>& exemplar,
                         const std::vector<Projections>& image) {
  const std::size_t scales = std::min(exemplar.size(), image.size());
  double total = 0;
  for (std::size_t s = 0; s < scales; ++s)
    for (std::size_t d = 0; d < patch_directions; ++d)
      total += quantile_distance(exemplar[s][d], image[s][d]) /
               std::max(deviation(exemplar[s][d]), 1e-3);
  return total / static_cast<double>(scales * patch_directions);
}

Projections colour_projections(const Image& image, double scale) {
  constexpr int most_axes = 4, random_count = 16;
  const int axes = std::min(most_axes, image.channels);
  const int extra = image.channels == 1 ? 0 : random_count;
  const auto directions = random_directions(image.channels, random_count, 0);
  const auto channels = static_cast<std::size_t>(image.channels);
  const auto places = spread_sample(std::int64_t{image.width} * image.height, 65536);
  Projections result(static_cast<std::size_t>(axes + extra), std::vector<float>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const float* in = image.pixels.data() + static_cast<std::size_t>(places[i]) * channels;
    for (int d = 0; d < axes; ++d)
      result[static_cast<std::size_t>(d)][i] = static_cast<float>(double{in[d]} * scale);
    for (int d = 0; d < extra; ++d) {
      double sum = 0;
      for (std::size_t c = 0; c < channels; ++c)
        sum += double{in[c]} * double{directions[c * random_count + static_cast<std::size_t>(d)]};
      result[static_cast<std::size_t>(axes + d)][i] = static_cast<float>(sum * scale);
    }
  }
  sort_all(result);
  return result;
}

double colour_wasserstein(const Projections& exemplar, const Projections& image) {
  double total = 0;
  for (std::size_t d = 0; d < exemplar.size(); ++d)
    total += quantile_distance(exemplar[d], image[d]);
  return total / static_cast<double>(exemplar.size());
}

}  // namespace gramloom
