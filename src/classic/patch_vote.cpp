#include "classic/patch_vote.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom {

namespace {

constexpr int rows_at_once = 32;
typedef float Pixel
    __attribute__((vector_size(field_features * sizeof(float)), aligned(4), may_alias));
typedef float Pair
    __attribute__((vector_size(2 * field_features * sizeof(float)), aligned(4), may_alias));

/// One row of patches, and what their `line`th lines say.
struct PatchRow {
  const std::ptrdiff_t* offsets;  // of what each would say about pixel 0, among the values
  const float* weights;
  int count;
  const float* values;  // of the exemplar

  template <class T>
  GRAMLOOM_INLINE T said(int patch, int pixel) const {
    return weights[patch] *
           *reinterpret_cast<const T*>(values + offsets[patch] + pixel * field_features);
  }
};

/// Adds what patches [first, end) say about a pixel.
GRAMLOOM_INLINE void add_pixel(const PatchRow& row, int pixel, int first, int end, float* sums) {
  Pixel& sum = *reinterpret_cast<Pixel*>(sums + pixel * field_features);
  Pixel colours = sum;
  for (int patch = first; patch < end; ++patch) colours += row.said<Pixel>(patch, pixel);
  sum = colours;
}

/// The same for a pixel and the next, each with all of its patches, of which they share all but
/// one.
GRAMLOOM_INLINE void add_pair(const PatchRow& row, int pixel, float* sums) {
  Pixel* sum = reinterpret_cast<Pixel*>(sums + pixel * field_features);
  const Pixel left = sum[0] + row.said<Pixel>(pixel - patch_border, pixel);
  Pair both = __builtin_shufflevector(left, sum[1], 0, 1, 2, 3, 4, 5, 6, 7);
  for (int patch = pixel - patch_border + 1; patch <= pixel; ++patch)
    both += row.said<Pair>(patch, pixel);
  sum[0] = __builtin_shufflevector(both, both, 0, 1, 2, 3);
  sum[1] = __builtin_shufflevector(both, both, 4, 5, 6, 7) + row.said<Pixel>(pixel + 1, pixel + 1);
}

/// Adds to each pixel's weight those of its patches.
GRAMLOOM_INLINE void add_weights(const PatchRow& row, float* __restrict weights) {
  const float* __restrict of_patch = row.weights;
  for (int pixel = 0; pixel < std::min(patch_border, row.count); ++pixel)
    for (int patch = 0; patch <= pixel; ++patch) weights[pixel] += of_patch[patch];
  for (int pixel = patch_border; pixel < row.count; ++pixel) {
    float weight = weights[pixel];
    for (int k = 0; k < field_patch; ++k) weight += of_patch[pixel - patch_border + k];
    weights[pixel] = weight;
  }
  for (int pixel = row.count; pixel < row.count + patch_border; ++pixel)
    for (int patch = std::max(0, pixel - patch_border); patch < row.count; ++patch)
      weights[pixel] += of_patch[patch];
}

/// Adds one row of patches' `line`th lines: weight · values to sums, weight to weights. Pixel by
/// pixel, whose sums stay in registers: added patch by patch, each would wait for the stores of the
/// one before. `offsets` is room for `count` numbers.
GRAMLOOM_SIMD void add_lines(const SmallOrigin* origins, const float* patch_weights, int count,
                             const Image& exemplar, int line, float* sums, float* weights,
                             std::ptrdiff_t* offsets) {
  for (int x = 0; x < count; ++x)
    offsets[x] =
        (static_cast<std::ptrdiff_t>(origins[x].y + line) * exemplar.width + origins[x].x - x) *
        field_features;
  const PatchRow row{offsets, patch_weights, count, exemplar.pixels.data()};
  add_weights(row, weights);
  for (int pixel = 0; pixel < std::min(patch_border, count); ++pixel)
    add_pixel(row, pixel, 0, pixel + 1, sums);
  int pixel = patch_border;
  for (; pixel + 1 < count; pixel += 2) add_pair(row, pixel, sums);
  for (; pixel < count; ++pixel) add_pixel(row, pixel, pixel - patch_border, pixel + 1, sums);
  for (pixel = count; pixel < count + patch_border; ++pixel)
    add_pixel(row, pixel, std::max(0, pixel - patch_border), count, sums);
}

/// Calls f(patch's row in the field, line of the patch) for the patches over row y of the canvas.
template <class F>
void for_each_patch_row(const PatchField& field, int y, F&& f) {
  for (int line = 0; line < field_patch; ++line) {
    int row = y - line;
    if (tiles_y(field.tile))
      row = (row % field.size.height + field.size.height) % field.size.height;
    if (row >= 0 && row < field.size.height) f(row, line);
  }
}

/// Patches' weights: (distance + floor) to the power of −5/8.
GRAMLOOM_SIMD void weigh(const float* __restrict distances, float floor, float* __restrict weights,
                         std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const float root = std::sqrt(distances[i] + floor);
    weights[i] = 1 / (root * std::sqrt(std::sqrt(root)));
  }
}

GRAMLOOM_SIMD void multiply(float* __restrict values, const float* __restrict by,
                            std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) values[i] *= by[i];
}

/// The weights of the patches over rows [first, last) of the canvas: of the row `border` above the
/// first one on. Those of rows that the field lacks are not set.
std::vector<float> weights_over(const PatchField& field, int first, int last, float floor) {
  std::vector<float> weights(field.index(0, last - first + patch_border));
  for (int y = first - patch_border; y < last; ++y) {
    int row = y;
    if (tiles_y(field.tile))
      row = (row % field.size.height + field.size.height) % field.size.height;
    if (row < 0 || row >= field.size.height) continue;
    float* of_row = weights.data() + field.index(0, y - first + patch_border);
    const auto count = static_cast<std::size_t>(field.size.width);
    weigh(field.distance.data() + field.index(0, row), floor, of_row, count);
    if (!field.confidence.empty())
      multiply(of_row, field.confidence.data() + field.index(0, row), count);
  }
  return weights;
}

/// (distance + floor) to the power of 3/8.
GRAMLOOM_SIMD void raise(const float* __restrict distances, float floor, float* __restrict powers,
                         std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const float fourth_root = std::sqrt(std::sqrt(distances[i] + floor));
    powers[i] = fourth_root * std::sqrt(fourth_root);
  }
}

/// Copies a canvas's first columns and rows behind its last ones where it tiles.
void repeat_border(Image& canvas, const PatchField& field) {
  const Size size = texture_size(field);
  for (int y = 0; y < size.height; ++y)
    for (int x = size.width; x < canvas.width; ++x)
      std::copy_n(canvas.at(x - size.width, y), field_features, canvas.at(x, y));
  for (int y = size.height; y < canvas.height; ++y)
    std::copy_n(canvas.at(0, y - size.height), canvas.width * field_features, canvas.at(0, y));
}

}  // namespace

Size texture_size(const PatchField& field) {
  return {field.size.width + (tiles_x(field.tile) ? 0 : patch_border),
          field.size.height + (tiles_y(field.tile) ? 0 : patch_border)};
}

Image vote(const PatchField& field, const Image& exemplar, float floor) {
  Image canvas(field.size.width + patch_border, field.size.height + patch_border, field_features);
  vote(field, exemplar, floor, canvas);
  return canvas;
}

void vote(const PatchField& field, const Image& exemplar, float floor, Image& canvas,
          const std::vector<unsigned char>& made) {
  const Size size = texture_size(field);
  parallel_for(size.height, rows_at_once, [&](std::int64_t first, std::int64_t last) {
    const std::vector<float> patch_weights =
        weights_over(field, static_cast<int>(first), static_cast<int>(last), floor);
    std::vector<float> sums, weights;
    std::vector<std::ptrdiff_t> offsets(static_cast<std::size_t>(field.size.width));
    for (int y = static_cast<int>(first); y < last; ++y) {
      sums.assign(static_cast<std::size_t>(canvas.width * field_features), 0.0f);
      weights.assign(static_cast<std::size_t>(canvas.width), 0.0f);
      for_each_patch_row(field, y, [&](int row, int line) {
        const std::size_t start = field.index(0, row);
        const float* weights_of_row =
            patch_weights.data() +
            field.index(0, y - line - static_cast<int>(first) + patch_border);
        add_lines(field.nearest.data() + start, weights_of_row, field.size.width, exemplar, line,
                  sums.data(), weights.data(), offsets.data());
      });
      for (int x = size.width; x < canvas.width; ++x) {
        const int back = x % size.width;
        for (int c = 0; c < field_features; ++c)
          sums[static_cast<std::size_t>(back * field_features + c)] +=
              sums[static_cast<std::size_t>(x * field_features + c)];
        weights[static_cast<std::size_t>(back)] += weights[static_cast<std::size_t>(x)];
      }
      Pixel* pixels = reinterpret_cast<Pixel*>(canvas.at(0, y));
      const unsigned char* is_made =
          made.empty() ? nullptr : made.data() + static_cast<std::ptrdiff_t>(y) * size.width;
      for (int x = 0; x < size.width; ++x)
        if (!is_made || is_made[x] != 0)
          pixels[x] =
              reinterpret_cast<const Pixel*>(sums.data())[x] / weights[static_cast<std::size_t>(x)];
    }
  });
  repeat_border(canvas, field);
}

std::vector<SmallOrigin> choose_pixels(const PatchField& field, const Image& canvas,
                                       const Image& exemplar) {
  const Size size = texture_size(field);
  std::vector<SmallOrigin> chosen(static_cast<std::size_t>(size.width) *
                                  static_cast<std::size_t>(size.height));
  parallel_for(size.height, 8, [&](std::int64_t first, std::int64_t last) {
    for (int y = static_cast<int>(first); y < last; ++y)
      for (int x = 0; x < size.width; ++x) {
        const float* mean = canvas.at(x, y);
        float best = std::numeric_limits<float>::infinity();
        SmallOrigin& pixel =
            chosen[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                   static_cast<std::size_t>(x)];
        for_each_said(field, x, y, [&](PatchOrigin origin) {
          const float* value = exemplar.at(origin.x, origin.y);
          float distance = 0;
          for (int c = 0; c < field_features; ++c)
            distance += (value[c] - mean[c]) * (value[c] - mean[c]);
          if (distance < best) {
            best = distance;
            pixel = origin;
          }
        });
      }
  });
  return chosen;
}

double robust_energy(const PatchField& field, float floor) {
  constexpr std::int64_t at_once = 1 << 20;
  std::vector<float> powers(std::min<std::size_t>(field.distance.size(), at_once));
  double sum = 0;
  for (std::int64_t begin = 0; begin < std::ssize(field.distance); begin += at_once) {
    const std::int64_t count = std::min(at_once, std::ssize(field.distance) - begin);
    parallel_for(count, 1 << 14, [&](std::int64_t first, std::int64_t last) {
      raise(field.distance.data() + begin + first, floor, powers.data() + first,
            static_cast<std::size_t>(last - first));
    });
    sum = std::accumulate(powers.begin(), powers.begin() + count, sum);
  }
  return sum;
}

}  // namespace gramloom
