#include "classic/patch_vote.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom {

namespace {

constexpr int border = field_patch - 1;
constexpr int lanes = 8;
typedef float Lanes __attribute__((vector_size(lanes * sizeof(float)), aligned(4), may_alias));

/// Adds one row of patches' `line`th lines: weight · values to sums, weight to weights.
GRAMLOOM_SIMD void add_lines(const PatchOrigin* origins, const float* patch_weights, int count,
                             const Image& exemplar, int line, float* sums, float* weights) {
  for (int x = 0; x < count; ++x) {
    const Lanes* from =
        reinterpret_cast<const Lanes*>(exemplar.at(origins[x].x, origins[x].y + line));
    Lanes* to = reinterpret_cast<Lanes*>(sums + x * field_features);
    Lanes* weight = reinterpret_cast<Lanes*>(weights + x);
    for (int k = 0; k < field_patch * field_features / lanes; ++k)
      to[k] += patch_weights[x] * from[k];
    *weight += patch_weights[x];
  }
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
    for (int y = static_cast<int>(first); y < last; ++y) {
      sums.assign(static_cast<std::size_t>(canvas.width * field_features), 0.0f);
      weights.assign(static_cast<std::size_t>(canvas.width), 0.0f);
      for_each_patch_row(field, y, [&](int row, int line) {
        const std::size_t start = field.index(0, row);
        add_lines(field.nearest.data() + start, patch_weights.data() + start, field.size.width,
                  exemplar, line, sums.data(), weights.data());
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
