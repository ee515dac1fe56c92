#include "classic/patch_vote.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom {

namespace {

constexpr int border = field_patch - 1;
typedef float Pixel
    __attribute__((vector_size(field_features * sizeof(float)), aligned(4), may_alias));

/// Adds one row of patches' `line`th lines: weight · values to sums, weight to weights. Pixel by
/// pixel, whose sums stay in registers: added patch by patch, each would wait for the stores of the
/// one before. `offsets` is room for `count` numbers.
GRAMLOOM_SIMD void add_lines(const PatchOrigin* origins, const float* patch_weights, int count,
                             const Image& exemplar, int line, float* sums, float* weights,
                             std::ptrdiff_t* offsets) {
  const float* values = exemplar.pixels.data();
  for (int x = 0; x < count; ++x)  // of what the patch would say about pixel 0
    offsets[x] =
        (static_cast<std::ptrdiff_t>(origins[x].y + line) * exemplar.width + origins[x].x - x) *
        field_features;
  const auto add = [&](int pixel, int first, int end) __attribute__((always_inline)) {
    Pixel& sum = *reinterpret_cast<Pixel*>(sums + pixel * field_features);
    Pixel colours = sum;
    float weight = weights[pixel];
    for (int x = first; x < end; ++x) {
      colours += patch_weights[x] *
                 *reinterpret_cast<const Pixel*>(values + offsets[x] + pixel * field_features);
      weight += patch_weights[x];
    }
    sum = colours;
    weights[pixel] = weight;
  };
  for (int pixel = 0; pixel < std::min(border, count); ++pixel) add(pixel, 0, pixel + 1);
  for (int pixel = border; pixel < count; ++pixel) add(pixel, pixel - border, pixel + 1);
  for (int pixel = count; pixel < count + border; ++pixel)
    add(pixel, std::max(0, pixel - border), count);
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
  return {field.size.width + (tiles_x(field.tile) ? 0 : border),
          field.size.height + (tiles_y(field.tile) ? 0 : border)};
}

Image vote(const PatchField& field, const Image& exemplar, float floor) {
  const Size size = texture_size(field);
  Image canvas(field.size.width + border, field.size.height + border, field_features);
  std::vector<float> patch_weights(field.distance.size());
  parallel_for(static_cast<std::int64_t>(patch_weights.size()), 4096,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last);
                      ++i) {
                   const float root = std::sqrt(field.distance[i] + floor);
                   patch_weights[i] = 1 / (root * std::sqrt(std::sqrt(root)));
                 }
               });
  parallel_for(size.height, 8, [&](std::int64_t first, std::int64_t last) {
    std::vector<float> sums, weights;
    std::vector<std::ptrdiff_t> offsets(static_cast<std::size_t>(field.size.width));
    for (int y = static_cast<int>(first); y < last; ++y) {
      sums.assign(static_cast<std::size_t>(canvas.width * field_features), 0.0f);
      weights.assign(static_cast<std::size_t>(canvas.width), 0.0f);
      for_each_patch_row(field, y, [&](int row, int line) {
        const std::size_t start = field.index(0, row);
        add_lines(field.nearest.data() + start, patch_weights.data() + start, field.size.width,
                  exemplar, line, sums.data(), weights.data(), offsets.data());
      });
      for (int x = size.width; x < canvas.width; ++x) {
        const int back = x % size.width;
        for (int c = 0; c < field_features; ++c)
          sums[static_cast<std::size_t>(back * field_features + c)] +=
              sums[static_cast<std::size_t>(x * field_features + c)];
        weights[static_cast<std::size_t>(back)] += weights[static_cast<std::size_t>(x)];
      }
      for (int x = 0; x < size.width; ++x)
        for (int c = 0; c < field_features; ++c)
          canvas.at(x, y)[c] = sums[static_cast<std::size_t>(x * field_features + c)] /
                               weights[static_cast<std::size_t>(x)];
    }
  });
  repeat_border(canvas, field);
  return canvas;
}

std::vector<PatchOrigin> choose_pixels(const PatchField& field, const Image& canvas,
                                       const Image& exemplar) {
  const Size size = texture_size(field);
  std::vector<PatchOrigin> chosen(static_cast<std::size_t>(size.width) *
                                  static_cast<std::size_t>(size.height));
  parallel_for(size.height, 8, [&](std::int64_t first, std::int64_t last) {
    for (int y = static_cast<int>(first); y < last; ++y)
      for (int x = 0; x < size.width; ++x) {
        const float* mean = canvas.at(x, y);
        float best = std::numeric_limits<float>::infinity();
        PatchOrigin& pixel =
            chosen[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                   static_cast<std::size_t>(x)];
        for_each_patch_row(field, y, [&](int row, int line) {
          for (int i = 0; i < field_patch; ++i) {
            int column = x - i;
            if (tiles_x(field.tile)) column = (column % size.width + size.width) % size.width;
            if (column < 0 || column >= field.size.width) continue;
            PatchOrigin origin = field.nearest[field.index(column, row)];
            origin.x += i;
            origin.y += line;
            const float* value = exemplar.at(origin.x, origin.y);
            float distance = 0;
            for (int c = 0; c < field_features; ++c)
              distance += (value[c] - mean[c]) * (value[c] - mean[c]);
            if (distance < best) {
              best = distance;
              pixel = origin;
            }
          }
        });
      }
  });
  return chosen;
}

double robust_energy(const PatchField& field, float floor) {
  double sum = 0;
  for (const float distance : field.distance) {
    const float fourth_root = std::sqrt(std::sqrt(distance + floor));
    sum += double{fourth_root * std::sqrt(fourth_root)};
  }
  return sum;
}

}  // namespace gramloom
