#include "signal/patch_penalty.h"

#include <algorithm>

#include "signal/patch_field.h"

namespace gramloom {

namespace {

std::size_t area(Size size) {
  return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

/// Means over windows of field_patch + 1 values of a line, cut at its ends.
void smooth_line(const std::vector<float>& from, std::size_t start, std::size_t step, int length,
                 std::vector<float>& to) {
  for (int i = 0; i < length; ++i) {
    const int low = std::max(0, i - field_patch / 2);
    const int high = std::min(length, i + field_patch / 2 + 1);
    float sum = 0;
    for (int k = low; k < high; ++k) sum += from[start + static_cast<std::size_t>(k) * step];
    to[start + static_cast<std::size_t>(i) * step] = sum / static_cast<float>(high - low);
  }
}

/// Half the way, so that patches do not all flee to the same place and back.
void approach(float& value, float goal) { value += 0.5f * (goal - value); }

}  // namespace

PatchPenalty::PatchPenalty(Size field_, Size origins_)
    : field(field_),
      origins(origins_),
      of_origin(area(origins)),
      of_shift(area({field.width + origins.width - 1, field.height + origins.height - 1})) {}

std::vector<float> usage(const PatchField& field, Size origins) {
  const auto width = static_cast<std::size_t>(origins.width);
  std::vector<float> used(area(origins)), rows(used.size());
  const float share = static_cast<float>(used.size()) / static_cast<float>(field.nearest.size());
  for (const PatchOrigin o : field.nearest)
    used[static_cast<std::size_t>(o.y) * width + static_cast<std::size_t>(o.x)] += share;
  for (int y = 0; y < origins.height; ++y)
    smooth_line(used, static_cast<std::size_t>(y) * width, 1, origins.width, rows);
  for (int x = 0; x < origins.width; ++x)
    smooth_line(rows, static_cast<std::size_t>(x), width, origins.height, used);
  return used;
}

void update(PatchPenalty& penalty, const PatchField& field, double uniformity,
            double largest_copy) {
  constexpr float patch_area = field_patch * field_patch;
  const std::vector<float> used = usage(field, penalty.origins);
  for (std::size_t i = 0; i < used.size(); ++i)
    approach(penalty.of_origin[i],
             static_cast<float>(uniformity) * patch_area * std::max(0.0f, used[i] - 1));

  std::vector<int> counts(penalty.of_shift.size());
  for (int y = 0; y < field.size.height; ++y)
    for (int x = 0; x < field.size.width; ++x)
      ++counts[penalty.shift(x, y, field.nearest[field.index(x, y)])];
  const float limit =
      std::max(1.0f, static_cast<float>(largest_copy) * static_cast<float>(used.size()));
  for (std::size_t i = 0; i < counts.size(); ++i)
    approach(penalty.of_shift[i],
             0.5f * patch_area * std::clamp(static_cast<float>(counts[i]) / limit - 1, 0.0f, 4.0f));
}

}  // namespace gramloom
