#include "classic/quilt_choice.h"

#include <algorithm>

#include "core/simd.h"

namespace gramloom {

namespace {

GRAMLOOM_SIMD float smallest(const std::vector<float>& values) {
  constexpr std::size_t lanes = 16;
  float low[lanes];
  std::fill_n(low, lanes, values[0]);
  std::size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes)
    for (std::size_t k = 0; k < lanes; ++k)
      low[k] = values[i + k] < low[k] ? values[i + k] : low[k];
  for (; i < values.size(); ++i) low[0] = std::min(low[0], values[i]);
  return *std::min_element(low, low + lanes);
}

GRAMLOOM_SIMD int count_up_to(const float* values, int count, float limit) {
  int found = 0;
  for (int i = 0; i < count; ++i) found += values[i] <= limit ? 1 : 0;
  return found;
}

}  // namespace

LeastError least_error(const std::vector<float>& errors) {
  const float least = smallest(errors);
  return {least, static_cast<std::size_t>(std::ranges::find(errors, least) - errors.begin())};
}

PatchOrigin draw_up_to(const std::vector<float>& errors, int width, float limit, Random& random) {
  std::vector<int> found;  // in each row of positions
  for (auto row = errors.begin(); row != errors.end(); row += width)
    found.push_back(count_up_to(&*row, width, limit));
  std::uint32_t all = 0;
  for (const int n : found) all += static_cast<std::uint32_t>(n);
  int rank = static_cast<int>(random.below(all));
  PatchOrigin position;
  while (rank >= found[static_cast<std::size_t>(position.y)])
    rank -= found[static_cast<std::size_t>(position.y++)];
  const float* row = errors.data() + static_cast<std::ptrdiff_t>(position.y) * width;
  while (row[position.x] > limit || rank-- > 0) ++position.x;
  return position;
}

DirectedErrors add_direction(const QuiltDirection& direction, PatchOrigin place,
                             const OverlapScale& overlap, std::vector<float>& errors,
                             Buffers& buffers) {
  std::vector<float> own = buffers.borrow();
  own = errors;
  direction.add_to(errors, place, overlap.scale, overlap.made);
  const LeastError least = least_error(errors);
  const DirectedErrors result{least.error, overlap.overlaps ? own[least.index] : least.error};
  buffers.give_back(std::move(own));
  return result;
}

void lay_pixels(const Image& old, const Image& fresh, PatchOrigin origin,
                const std::vector<float>& weights, PatchOrigin place, Image& canvas,
                SourceMap& source) {
  std::size_t i = 0;
  for (int y = 0; y < old.height; ++y)
    for (int x = 0; x < old.width; ++x, ++i) {
      const int column = (place.x + x) % canvas.width, row = (place.y + y) % canvas.height;
      if (weights[i] >= 0.5f) *source.at(column, row) = {origin.x + x, origin.y + y};
      float* pixel = canvas.at(column, row);
      const float *from = old.at(x, y), *to = fresh.at(x, y);
      for (int c = 0; c < old.channels; ++c)
        pixel[c] = weights[i] >= 1 ? to[c]
                   : weights[i] <= 0
                       ? from[c]
                       : std::clamp(from[c] + weights[i] * (to[c] - from[c]),
                                    std::min(from[c], to[c]), std::max(from[c], to[c]));
    }
}

}  // namespace gramloom
