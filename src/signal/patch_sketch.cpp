#include "signal/patch_sketch.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/threads.h"

namespace gramloom {

namespace {

typedef float Features
    __attribute__((vector_size(field_features * sizeof(float)), aligned(4), may_alias));
typedef std::int8_t Whole __attribute__((vector_size(field_features), aligned(1), may_alias));

constexpr int quarter = field_patch / 2;
constexpr int rows_at_once = 32;

/// The whole numbers of the quarters whose upper left pixels are the first `count` of a row.
GRAMLOOM_SIMD void sketch_quarters(const Image& features, int y, const SketchScale& scale,
                                   int count, float* __restrict columns,
                                   std::int8_t* __restrict whole) {
  const int values = features.width * field_features;
  std::copy_n(features.at(0, y), values, columns);
  for (int line = 1; line < quarter; ++line) {
    const float* row = features.at(0, y + line);
    for (int i = 0; i < values; ++i) columns[i] += row[i];
  }
  const Features middle = *reinterpret_cast<const Features*>(scale.middle.data()), zero{};
  const float per_step = 1 / (scale.step * quarter);
  for (int x = 0; x < count; ++x) {
    const Features* sum = reinterpret_cast<const Features*>(columns) + x;
    Features steps = ((sum[0] + sum[1]) + (sum[2] + sum[3]) - middle) * per_step;
    steps = steps < zero - 127 ? zero - 127 : steps;
    steps = steps > zero + 127 ? zero + 127 : steps;
    // Rounded: what is converted is positive.
    reinterpret_cast<Whole*>(whole)[x] =
        __builtin_convertvector(__builtin_convertvector(steps + 127.5f, Four) - 127, Whole);
  }
}

/// The sketches of the patches in rows [first, last).
void sketch_rows(const Image& features, const SketchScale& scale, int first, int last,
                 PatchSketch* sketch) {
  const int width = patch_origins(features.size()).width, quarters = width + quarter;
  const auto row_bytes = static_cast<std::size_t>(quarters * field_features);
  std::vector<float> columns(static_cast<std::size_t>(features.width * field_features));
  std::vector<std::int8_t> whole(static_cast<std::size_t>(last - first + quarter) * row_bytes);
  for (int y = 0; y < last - first + quarter; ++y)
    sketch_quarters(features, first + y, scale, quarters, columns.data(),
                    whole.data() + static_cast<std::size_t>(y) * row_bytes);
  for (int y = 0; y < last - first; ++y) {
    const std::int8_t* above = whole.data() + static_cast<std::size_t>(y) * row_bytes;
    const std::int8_t* below = above + quarter * row_bytes;
    for (int x = 0; x < width; ++x, ++sketch) {
      std::int8_t* to = sketch->values.data();
      for (const std::int8_t* from :
           {above, above + quarter * field_features, below, below + quarter * field_features}) {
        std::memcpy(to, from + x * field_features, field_features);
        to += field_features;
      }
    }
  }
}

}  // namespace

SketchScale sketch_scale(const Image& features) {
  SketchScale scale{};
  const auto count = static_cast<double>(features.width) * features.height;
  double widest = 0;
  for (std::size_t c = 0; c < field_features; ++c) {
    double sum = 0, squares = 0;
    for (std::size_t i = c; i < features.pixels.size(); i += field_features) {
      const double value = features.pixels[i];
      sum += value;
      squares += value * value;
    }
    scale.middle[c] = static_cast<float>(quarter * quarter * sum / count);
    widest = std::max(widest, squares / count - sum / count * (sum / count));
  }
  // Two standard deviations of a quarter of one colour are 127 steps.
  scale.step = widest > 0 ? static_cast<float>(quarter * 2 * std::sqrt(widest) / 127) : 1;
  return scale;
}

std::vector<PatchSketch> sketch_patches(const Image& features, const SketchScale& scale, int first,
                                        int last) {
  const auto width = static_cast<std::size_t>(patch_origins(features.size()).width);
  std::vector<PatchSketch> sketches(width * static_cast<std::size_t>(last - first));
  sketch_rows(features, scale, first, last, sketches.data());
  return sketches;
}

std::vector<PatchSketch> sketch_patches(const Image& features, const SketchScale& scale) {
  const Size size = patch_origins(features.size());
  const auto width = static_cast<std::size_t>(size.width);
  std::vector<PatchSketch> sketches(width * static_cast<std::size_t>(size.height));
  parallel_for(size.height, rows_at_once, [&](std::int64_t first, std::int64_t last) {
    sketch_rows(features, scale, static_cast<int>(first), static_cast<int>(last),
                sketches.data() + static_cast<std::size_t>(first) * width);
  });
  return sketches;
}

int telling_difference(float squared_distance, const SketchScale& scale) {
  // Rounding changes each of the 16 numbers' differences by at most 1, their root sum of squares by
  // at most 4; the rest is for rounding of floats.
  const float steps = 1.0001f * std::sqrt(squared_distance) / scale.step + 5;
  const float squares = steps * steps;
  return squares < 2e9f ? static_cast<int>(squares) : 2'000'000'000;
}

}  // namespace gramloom
