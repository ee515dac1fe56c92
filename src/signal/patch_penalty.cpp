#include "signal/patch_penalty.h"

#include <algorithm>
#include <utility>

#include "core/simd.h"
#include "signal/patch_field.h"

namespace gramloom {

namespace {

/// The window of field_patch + 1 values about i, cut at the ends of a line.
struct Window {
  int low, high;
  Window(int i, int length)
      : low(std::max(0, i - field_patch / 2)), high(std::min(length, i + field_patch / 2 + 1)) {}
  float size() const { return static_cast<float>(high - low); }
};

GRAMLOOM_SIMD void add(const float* __restrict from, std::size_t count, float* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += from[i];
}

GRAMLOOM_SIMD void divide(float* __restrict values, std::size_t count, float by) {
  for (std::size_t i = 0; i < count; ++i) values[i] /= by;
}

/// Half the way, so that patches do not all flee to the same place and back.
GRAMLOOM_INLINE void approach(float& value, float goal) { value += 0.5f * (goal - value); }

GRAMLOOM_SIMD void approach_use(float* __restrict penalties, const float* __restrict used,
                                std::size_t count, float weight) {
  for (std::size_t i = 0; i < count; ++i)
    approach(penalties[i], weight * std::max(0.0f, used[i] - 1));
}

GRAMLOOM_SIMD int largest_of(const int* counts, int count) {
  int largest = 0;
  for (int i = 0; i < count; ++i) largest = counts[i] > largest ? counts[i] : largest;
  return largest;
}

GRAMLOOM_SIMD void approach_counts(float* __restrict penalties, const int* __restrict counts,
                                   std::size_t count, float limit, float weight) {
  for (std::size_t i = 0; i < count; ++i) {
    const float excess = static_cast<float>(counts[i]) / limit - 1;
    approach(penalties[i], weight * std::min(4.0f, std::max(0.0f, excess)));
  }
}

constexpr int side = SparsePlane::side;

/// How many patches have each shift, for some rows of shifts: as many as are not all counted yet.
/// A row lies where the one `rows` above it was.
struct ShiftCounts {
  int width, rows;
  std::vector<int> counts;

  ShiftCounts(Size shifts, Size origins)
      : width((shifts.width + side - 1) / side * side),
        rows((origins.height + 3 * side) / side * side),
        counts(pixel_count({width, rows})) {}
  int* at(int y) { return counts.data() + row(y); }
  const int* at(int y) const { return counts.data() + row(y); }
  std::size_t row(int y) const { return to_size(width) * to_size(y % rows); }
};

/// Calls f(row of squares, counts) for all rows of the penalty's squares, when their shifts are
/// counted. Patches further down have shifts further up: the last rows come first.
template <class F>
void for_each_square_row(const PatchPenalty& penalty, const PatchField& field, F&& f) {
  const Size shifts = penalty.shifts();
  ShiftCounts counts(shifts, penalty.origins);
  int next = (shifts.height - 1) / side;  // row of squares
  const auto finish_down_to = [&](int shift) {
    for (; next >= 0 && next * side >= shift; --next) {
      f(next, std::as_const(counts));
      std::fill_n(counts.at(next * side), pixel_count({counts.width, side}), 0);
    }
  };
  for (int y = 0; y < field.size.height; ++y) {
    if (y % side == 0) finish_down_to(penalty.shift(0, y, {0, penalty.origins.height}).y);
    for (int x = 0; x < field.size.width; ++x) {
      if (!field.looks_for(field.index(x, y))) continue;
      const PatchOrigin shift = penalty.shift(x, y, field.nearest[field.index(x, y)]);
      ++counts.at(shift.y)[shift.x];
    }
  }
  finish_down_to(0);
}

/// Moves the penalties of a row of squares. Those that are 0 and stay so take no memory.
void approach_square_row(PatchPenalty& penalty, int row, const ShiftCounts& counts, float limit,
                         float weight) {
  for (int column = 0; column < counts.width / side; ++column) {
    int largest = 0;
    for (int y = 0; y < side; ++y)
      largest = std::max(largest, largest_of(counts.at(row * side + y) + column * side, side));
    if (static_cast<float>(largest) <= limit && penalty.of_shift.is_zero(column, row)) continue;
    float* values = penalty.of_shift.values(column, row);
    for (int y = 0; y < side; ++y)
      approach_counts(values + y * side, counts.at(row * side + y) + column * side, side, limit,
                      weight);
  }
}

}  // namespace

PatchPenalty::PatchPenalty(Size field_, Size origins_)
    : field(field_), origins(origins_), of_origin(pixel_count(origins)), of_shift(shifts()) {}

std::vector<float> usage(const PatchField& field, Size origins) {
  const auto width = static_cast<std::size_t>(origins.width);
  std::vector<float> used(pixel_count(origins)), rows(used.size());
  const auto patches = field.confidence.empty()
                           ? std::ssize(field.nearest)
                           : std::ranges::count_if(field.confidence, [](float c) { return c > 0; });
  const float share = static_cast<float>(used.size()) / static_cast<float>(patches);
  for (std::size_t i = 0; i < field.nearest.size(); ++i) {
    const SmallOrigin o = field.nearest[i];
    if (field.looks_for(i)) used[o.y * width + o.x] += share;
  }
  for (int y = 0; y < origins.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * width;
    for (int x = 0; x < origins.width; ++x) {
      const Window window(x, origins.width);
      float sum = 0;
      for (int k = window.low; k < window.high; ++k) sum += used[row + static_cast<std::size_t>(k)];
      rows[row + static_cast<std::size_t>(x)] = sum / window.size();
    }
  }
  std::ranges::fill(used, 0.0f);
  for (int y = 0; y < origins.height; ++y) {
    const Window window(y, origins.height);
    float* to = used.data() + static_cast<std::size_t>(y) * width;
    for (int k = window.low; k < window.high; ++k)
      add(rows.data() + static_cast<std::size_t>(k) * width, width, to);
    divide(to, width, window.size());
  }
  return used;
}

void update(PatchPenalty& penalty, const PatchField& field, double uniformity, double largest_copy,
            double usable) {
  constexpr float patch_area = field_patch * field_patch;
  std::vector<float> used = usage(field, penalty.origins);
  if (usable < 1)
    for (float& value : used) value *= static_cast<float>(usable);
  approach_use(penalty.of_origin.data(), used.data(), used.size(),
               static_cast<float>(uniformity) * patch_area);

  const float limit =
      std::max(1.0f, static_cast<float>(largest_copy * usable) * static_cast<float>(used.size()));
  for_each_square_row(penalty, field, [&](int row, const ShiftCounts& counts) {
    approach_square_row(penalty, row, counts, limit, 0.5f * patch_area);
  });
}

}  // namespace gramloom
