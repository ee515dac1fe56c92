#include "classic/quilting.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "classic/check_input.h"
#include "classic/overlap.h"
#include "classic/patch_grid.h"
#include "classic/seam.h"
#include "core/error.h"
#include "core/simd.h"
#include "core/threads.h"

namespace gramloom {

namespace {

struct Position {
  int x = 0;
  int y = 0;
};

/// Buffers that patches laid at the same time borrow and give back, so that there are only as many
/// as threads.
class Buffers {
 public:
  std::vector<float> borrow() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return {};
    std::vector<float> buffer = std::move(free_.back());
    free_.pop_back();
    return buffer;
  }
  void give_back(std::vector<float> buffer) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(buffer));
  }

 private:
  std::mutex mutex_;
  std::vector<std::vector<float>> free_;
};

struct Quilt {
  const QuiltingParams& params;
  const Image& exemplar;
  PatchAxis x, y;
  OverlapErrors overlap_errors;
  Image canvas;
  Buffers buffers;

  Size patch() const { return {x.patch, y.patch}; }
};

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

/// One of the positions whose error is at most `limit`, all equally likely; there is one.
Position draw(const std::vector<float>& errors, int width, float limit, Random& random) {
  std::vector<int> found;  // in each row of positions
  for (auto row = errors.begin(); row != errors.end(); row += width)
    found.push_back(count_up_to(&*row, width, limit));
  std::uint32_t all = 0;
  for (const int n : found) all += static_cast<std::uint32_t>(n);
  int rank = static_cast<int>(random.below(all));
  Position position;
  while (rank >= found[static_cast<std::size_t>(position.y)])
    rank -= found[static_cast<std::size_t>(position.y++)];
  const float* row = errors.data() + static_cast<std::ptrdiff_t>(position.y) * width;
  while (row[position.x] > limit || rank-- > 0) ++position.x;
  return position;
}

/// The part of `image` under a patch at (left, top), which may reach around its edges.
Image under(const Image& image, int left, int top, Size patch) {
  Image result(patch, image.channels);
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x)
      std::copy_n(image.at((left + x) % image.width, (top + y) % image.height), image.channels,
                  result.at(x, y));
  return result;
}

Position choose(Quilt& quilt, const Image& old, const Sides& sides, Random& random) {
  const Size positions = quilt.overlap_errors.positions();
  if (!sides.any())
    return {static_cast<int>(random.below(static_cast<std::uint32_t>(positions.width))),
            static_cast<int>(random.below(static_cast<std::uint32_t>(positions.height)))};
  std::vector<float> errors = quilt.buffers.borrow();
  quilt.overlap_errors.compute(old, sides, errors);
  const float limit = (1 + static_cast<float>(quilt.params.tolerance)) * smallest(errors) +
                      quilt.overlap_errors.noise(sides);
  const Position position = draw(errors, positions.width, limit, random);
  quilt.buffers.give_back(std::move(errors));
  return position;
}

void lay(Quilt& quilt, const PatchSlot& slot, Random random) {
  const int left = quilt.x.starts[static_cast<std::size_t>(slot.column)];
  const int top = quilt.y.starts[static_cast<std::size_t>(slot.row)];
  const Size patch = quilt.patch();
  const Image old = under(quilt.canvas, left, top, patch);
  const Position position = choose(quilt, old, slot.sides, random);
  const Image fresh = under(quilt.exemplar, position.x, position.y, patch);
  const std::vector<float> weights =
      feathered(cut_mask(old, fresh, slot.sides), patch, slot.sides, quilt.params.feather);
  std::size_t i = 0;
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x, ++i) {
      float* pixel =
          quilt.canvas.at((left + x) % quilt.canvas.width, (top + y) % quilt.canvas.height);
      const float *from = old.at(x, y), *to = fresh.at(x, y);
      for (int c = 0; c < old.channels; ++c)
        pixel[c] = weights[i] >= 1 ? to[c]
                   : weights[i] <= 0
                       ? from[c]
                       : std::clamp(from[c] + weights[i] * (to[c] - from[c]),
                                    std::min(from[c], to[c]), std::max(from[c], to[c]));
    }
}

PatchAxis cover_axis(const QuiltingParams& params, int exemplar, int length, bool wraps) {
  const int patch = std::min(params.patch_size, std::max(1, exemplar * 3 / 4));
  const int overlap = static_cast<int>(params.overlap * patch + 0.5);
  return cover(length, patch, std::max(overlap, params.overlap > 0 ? 1 : 0), wraps);
}

}  // namespace

Texture synthesise(const QuiltingParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control) {
  check_fields(params);
  check_input(exemplar, target);
  const PatchAxis x = cover_axis(params, exemplar.width, target.size.width, tiles_x(target.tile));
  const PatchAxis y = cover_axis(params, exemplar.height, target.size.height, tiles_y(target.tile));
  Quilt quilt{params,
              exemplar,
              x,
              y,
              OverlapErrors(exemplar, {x.patch, y.patch}),
              Image(target.size, exemplar.channels),
              {}};
  std::int64_t laid = 0;
  const std::int64_t patches = std::int64_t{x.count()} * y.count();
  for (const std::vector<PatchSlot>& wave : waves(x, y)) {
    parallel_for(static_cast<std::int64_t>(wave.size()), 1, [&](std::int64_t i, std::int64_t) {
      const PatchSlot& slot = wave[static_cast<std::size_t>(i)];
      lay(quilt, slot,
          random.stream(static_cast<std::uint64_t>(slot.row * x.count() + slot.column)));
    });
    laid += static_cast<std::int64_t>(wave.size());
    control.step(laid, patches);
  }
  return {std::move(quilt.canvas), {}};
}

Cost estimate(const QuiltingParams& params, Size exemplar, int channels, const Target& target) {
  const PatchAxis x = cover_axis(params, exemplar.width, target.size.width, tiles_x(target.tile));
  const PatchAxis y = cover_axis(params, exemplar.height, target.size.height, tiles_y(target.tile));
  const double pixels = static_cast<double>(exemplar.width) * exemplar.height;
  const double result = static_cast<double>(target.size.width) * target.size.height;
  const double patches = static_cast<double>(x.count()) * y.count();
  const double overlap = x.before(x.count() - 1) + y.before(y.count() - 1);
  return {.bytes = 4 * channels * (5 * pixels + result) + (8 + 4.0 * thread_count()) * pixels,
          .seconds = patches * pixels * (8 + 0.25 * overlap * channels) * 1e-9 / 2};
}

}  // namespace gramloom
